// A spring clip: a half ring with two arms of 30 mm, 2 mm thick and 8 mm wide.
SetFactory("OpenCASCADE");
r = 0.01;
t = 0.002;
l = 0.03;
w = 0.008;
Disk(1) = {0, 0, 0, r + t};
Disk(2) = {0, 0, 0, r};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Rectangle(4) = {0, -2 * r, 0, 4 * r, 4 * r};
BooleanDifference(5) = { Surface{3}; Delete; }{ Surface{4}; Delete; };
Rectangle(6) = {0, r, 0, l, t};
Rectangle(7) = {0, -r - t, 0, l, t};
BooleanUnion(8) = { Surface{5}; Delete; }{ Surface{6, 7}; Delete; };
Extrude {0, 0, w} { Surface{8}; Layers{2}; }
e = 1e-6;
lower() = Surface In BoundingBox{l - e, -r - t - e, -e, l + e, -r + e, w + e};
upper() = Surface In BoundingBox{l - e, r - e, -e, l + e, r + t + e, w + e};
Physical Volume("clip") = {1};
Physical Surface("lower-end") = {lower()};
Physical Surface("upper-end") = {upper()};
Mesh.MeshSizeMax = 0.003;
Mesh.MeshSizeFromCurvature = 12;
