// The 45 degree bend of Bathe and Bolourchi: an arc of radius 100 with a square section of 1 x 1, in the plane z = 0. It
// begins at the origin in the direction of y and bends towards x. Units: m.
SetFactory("OpenCASCADE");

radius  = 100; // of the centre line, around (radius, 0, 0)
section = 1;

// The section at the start, turned from the plane z = 0 to be across the arc.
Rectangle(1) = {-section / 2, -section / 2, 0, section, section};
Rotate {{1, 0, 0}, {0, 0, 0}, Pi / 2} { Surface{1}; }
arc() = Extrude {{0, 0, 1}, {radius, 0, 0}, -Pi / 4} { Surface{1}; };

// The two ends: the only surfaces that lie within small boxes there.
b = section;
x = radius * (1 - Cos(Pi / 4));
y = radius * Sin(Pi / 4);
start() = Surface In BoundingBox{-b, -b, -b, b, b, b};
end()   = Surface In BoundingBox{x - b, y - b, -b, x + b, y + b, b};

Physical Volume("bend", 1)   = {arc(1)};
Physical Surface("fixed", 1) = {start()};
Physical Surface("tip", 2)   = {end()};

// One cell across, and enough along the arc for straight sides to follow it.
Mesh.MeshSizeMin = 2;
Mesh.MeshSizeMax = 2;
