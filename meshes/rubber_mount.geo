// A rubber cylinder, 40 mm wide and 30 mm high, between two steel plates of
// 60 x 60 x 5 mm; in mm.
SetFactory("OpenCASCADE");
Box(1) = {-30, -30, 0, 60, 60, 5};
Cylinder(2) = {0, 0, 5, 0, 0, 30, 20};
Box(3) = {-30, -30, 35, 60, 60, 5};
