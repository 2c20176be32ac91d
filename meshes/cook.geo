// Cook's membrane: a tapered panel, 5 thick, clamped at its left edge and sheared at its right one. Cells are smallest at the upper end
// of that, where the shear stress jumps: what is asked for is the displacement there. Units: m.
SetFactory("OpenCASCADE");

thickness = 5;
Point(1) = {0, 0, 0, 3};
Point(2) = {48, 44, 0, 6};
Point(3) = {48, 60, 0, 0.5};
Point(4) = {0, 44, 0, 3};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
panel() = Extrude {0, 0, thickness} { Surface{1}; };

e = 0.01;
clamped() = Surface In BoundingBox{-e, -e, -e, e, 60, thickness + e};
loaded()  = Surface In BoundingBox{48 - e, 40, -e, 48 + e, 60 + e, thickness + e};
front()   = Surface In BoundingBox{-e, -e, -e, 50, 61, e};
back()    = Surface In BoundingBox{-e, -e, thickness - e, 50, 61, thickness + e};

Physical Volume("panel", 1)    = {panel(1)};
Physical Surface("clamped", 1) = {clamped()};
Physical Surface("loaded", 2)  = {loaded()};
Physical Surface("front", 3)   = {front()};
Physical Surface("back", 4)    = {back()};
