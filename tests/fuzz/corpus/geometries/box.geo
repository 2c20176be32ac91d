// A box of a few cells.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 2, 1};
Physical Volume("body", 1) = {1};
Physical Surface("left", 7) = {1};
