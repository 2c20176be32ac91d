// An eighth of a thick-walled sphere around the origin, where x, y, z > 0: inner radius 1, outer radius 2. Units: m.
SetFactory("OpenCASCADE");

inner = 1;
outer = 2;

Sphere(1) = {0, 0, 0, outer, 0, Pi / 2, Pi / 2};
Sphere(2) = {0, 0, 0, inner, 0, Pi / 2, Pi / 2};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

// Surfaces by the boxes that they lie in.
e = 0.1;
b = outer + e;
x()      = Surface In BoundingBox{-e, -e, -e, e, b, b};
y()      = Surface In BoundingBox{-e, -e, -e, b, e, b};
z()      = Surface In BoundingBox{-e, -e, -e, b, b, e};
inside() = Surface In BoundingBox{-e, -e, -e, inner + e, inner + e, inner + e};
outside() = Surface{:};
outside() -= {x(), y(), z(), inside()};

Physical Volume("sphere", 1)   = {3};
Physical Surface("x-min", 1)   = {x()};
Physical Surface("y-min", 2)   = {y()};
Physical Surface("z-min", 3)   = {z()};
Physical Surface("inside", 4)  = {inside()};
Physical Surface("outside", 5) = {outside()};

Mesh.MeshSizeMin = 0.7;
Mesh.MeshSizeMax = 0.7;
