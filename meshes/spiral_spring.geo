// A spiral (helical) spring of round wire; the ends of the wire are flat. Units: m.
SetFactory("OpenCASCADE");

radius  = 0.020; // of the helix, around the z axis
wire    = 0.003; // radius of the wire
pitch   = 0.012; // rise of a turn
n_turns = 3;

// The helix, as a spline through points.
n_points = 12 * n_turns;
For i In {0 : n_points}
  angle = 2 * Pi * n_turns * i / n_points;
  Point(1 + i) = {radius * Cos(angle), radius * Sin(angle), pitch * n_turns * i / n_points};
EndFor
Spline(1) = {1 : n_points + 1};
Wire(1)   = {1};

// The section of the wire at the start of the helix, turned from the plane z = 0 to be across the helix.
Disk(1) = {radius, 0, 0, wire};
Rotate {{1, 0, 0}, {radius, 0, 0}, Pi / 2 + Atan2(pitch, 2 * Pi * radius)} { Surface{1}; }
coil() = Extrude { Surface{1}; } Using Wire {1};
Delete { Surface{1}; Curve{1}; }

// The two flat ends: the only surfaces that lie within small boxes there.
b = 2 * wire;
h = pitch * n_turns;
start() = Surface In BoundingBox{radius - b, -b, -b, radius + b, b, b};
end()   = Surface In BoundingBox{radius - b, -b, h - b, radius + b, b, h + b};

Physical Volume("spring", 1)  = {coil(0)};
Physical Surface("bottom", 1) = {start()};
Physical Surface("top", 2)    = {end()};

Mesh.MeshSizeMin = 0.003;
Mesh.MeshSizeMax = 0.003;
