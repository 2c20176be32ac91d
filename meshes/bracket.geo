// An angle bracket: a back plate that is screwed to a wall through two holes, an arm with a hole at its end for the
// load, and a rounded inner corner. Units: m.
SetFactory("OpenCASCADE");

thickness = 0.008;
width     = 0.060; // in y
height    = 0.080; // of the back plate, in z
reach     = 0.100; // of the arm, in x
fillet    = 0.012; // of the inner corner
wall_hole = 0.005; // radii
tip_hole  = 0.008;

// The profile in the plane y = 0: the back plate along z, the arm along x at the top.
Point(1) = {0, 0, 0};
Point(2) = {thickness, 0, 0};
Point(3) = {thickness, 0, height - thickness - fillet};
Point(4) = {thickness + fillet, 0, height - thickness - fillet};
Point(5) = {thickness + fillet, 0, height - thickness};
Point(6) = {reach, 0, height - thickness};
Point(7) = {reach, 0, height};
Point(8) = {0, 0, height};
Line(1)   = {1, 2};
Line(2)   = {2, 3};
Circle(3) = {3, 4, 5};
Line(4)   = {5, 6};
Line(5)   = {6, 7};
Line(6)   = {7, 8};
Line(7)   = {8, 1};
Curve Loop(1)    = {1, 2, 3, 4, 5, 6, 7};
Plane Surface(1) = {1};
Extrude {0, width, 0} { Surface{1}; }

// Two holes through the back plate, one through the arm.
Cylinder(11) = {-thickness, width / 4, height / 3, 3 * thickness, 0, 0, wall_hole};
Cylinder(12) = {-thickness, 3 * width / 4, height / 3, 3 * thickness, 0, 0, wall_hole};
Cylinder(13) = {reach - 0.02, width / 2, height - 2 * thickness, 0, 0, 3 * thickness, tip_hole};
part() = BooleanDifference{ Volume{1}; Delete; }{ Volume{11, 12, 13}; Delete; };

// Surfaces by where they are.
e = 1e-5;
back()  = Surface In BoundingBox{-e, -e, -e, e, width + e, height + e};
front() = Surface In BoundingBox{reach - e, -e, -e, reach + e, width + e, height + e};
top()   = Surface In BoundingBox{-e, -e, height - e, reach + e, width + e, height + e};
hole1() = Surface In BoundingBox{-e, width / 4 - wall_hole - e, height / 3 - wall_hole - e,
                                 thickness + e, width / 4 + wall_hole + e, height / 3 + wall_hole + e};
hole2() = Surface In BoundingBox{-e, 3 * width / 4 - wall_hole - e, height / 3 - wall_hole - e,
                                 thickness + e, 3 * width / 4 + wall_hole + e, height / 3 + wall_hole + e};
hole3() = Surface In BoundingBox{reach - 0.02 - tip_hole - e, width / 2 - tip_hole - e, height - thickness - e,
                                 reach - 0.02 + tip_hole + e, width / 2 + tip_hole + e, height + e};

Physical Volume("bracket", 1)      = {part()};
Physical Surface("wall", 1)        = {back()};
Physical Surface("wall-holes", 2)  = {hole1(), hole2()};
Physical Surface("tip", 3)         = {front()};
Physical Surface("tip-hole", 4)    = {hole3()};
Physical Surface("top", 5)         = {top()};

Mesh.MeshSizeMin = 0.002;
Mesh.MeshSizeMax = 0.010;
Mesh.MeshSizeFromCurvature = 10;
