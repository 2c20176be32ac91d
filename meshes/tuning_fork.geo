// A tuning fork: two straight prongs of square section, a half ring that joins them, a round stem below. Units: m.
SetFactory("OpenCASCADE");

thickness = 0.005; // of a prong, in x and y
gap       = 0.010; // between the prongs
length    = 0.080; // of the straight part of a prong, in z
stem      = 0.030; // length
radius    = 0.003; // of the stem

inner = gap / 2;
outer = gap / 2 + thickness;

// Prongs above z = 0, the half ring below.
Box(1) = {-outer, -thickness / 2, 0, thickness, thickness, length};
Box(2) = {inner, -thickness / 2, 0, thickness, thickness, length};
Cylinder(3) = {0, -thickness / 2, 0, 0, thickness, 0, outer};
Cylinder(4) = {0, -thickness / 2, 0, 0, thickness, 0, inner};
Box(5) = {-outer, -thickness / 2, 0, 2 * outer, thickness, outer};
ring() = BooleanDifference{ Volume{3}; Delete; }{ Volume{4, 5}; Delete; };

// The stem starts inside of the ring, so that they are one piece.
Cylinder(6) = {0, 0, -outer + thickness / 2, 0, 0, -stem - thickness / 2, radius};
fork() = BooleanUnion{ Volume{ring()}; Delete; }{ Volume{1, 2, 6}; Delete; };

e = 1e-5;
bottom() = Surface In BoundingBox{-radius - e, -radius - e, -outer - stem - e, radius + e, radius + e, -outer - stem + e};
left()   = Surface In BoundingBox{-outer - e, -thickness, length - e, -inner + e, thickness, length + e};
right()  = Surface In BoundingBox{inner - e, -thickness, length - e, outer + e, thickness, length + e};
outer_left()  = Surface In BoundingBox{-outer - e, -thickness, -e, -outer + e, thickness, length + e};
outer_right() = Surface In BoundingBox{outer - e, -thickness, -e, outer + e, thickness, length + e};

Physical Volume("fork", 1)         = {fork()};
Physical Surface("stem", 1)        = {bottom()};
Physical Surface("prong-left", 2)  = {left()};
Physical Surface("prong-right", 3) = {right()};
Physical Surface("side-left", 4)   = {outer_left()};
Physical Surface("side-right", 5)  = {outer_right()};

Mesh.MeshSizeMin = 0.003;
Mesh.MeshSizeMax = 0.003;
