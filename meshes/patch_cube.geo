// A unit cube with its corner at the origin, in irregular cells: for patch tests. Units: m.
SetFactory("OpenCASCADE");

Box(1) = {0, 0, 0, 1, 1, 1};

e = 1e-3;
x_min() = Surface In BoundingBox{-e, -e, -e, e, 1 + e, 1 + e};
x_max() = Surface In BoundingBox{1 - e, -e, -e, 1 + e, 1 + e, 1 + e};
y_min() = Surface In BoundingBox{-e, -e, -e, 1 + e, e, 1 + e};
y_max() = Surface In BoundingBox{-e, 1 - e, -e, 1 + e, 1 + e, 1 + e};
z_min() = Surface In BoundingBox{-e, -e, -e, 1 + e, 1 + e, e};
z_max() = Surface In BoundingBox{-e, -e, 1 - e, 1 + e, 1 + e, 1 + e};

Physical Volume("cube", 1)   = {1};
Physical Surface("x-min", 1) = {x_min()};
Physical Surface("x-max", 2) = {x_max()};
Physical Surface("y-min", 3) = {y_min()};
Physical Surface("y-max", 4) = {y_max()};
Physical Surface("z-min", 5) = {z_min()};
Physical Surface("z-max", 6) = {z_max()};

// Cells of different sizes: no symmetry may help.
Mesh.MeshSizeMin = 0.25;
Mesh.MeshSizeMax = 0.4;
MeshSize { PointsOf{ Volume{1}; } } = 0.4;
MeshSize { 1 } = 0.25;
