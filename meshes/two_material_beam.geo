// A beam of two materials in a row that share the nodes of their interface. Units: m.
SetFactory("OpenCASCADE");

length = 0.200; // of each half, in x
width  = 0.040; // in y and z

Box(1) = {0, 0, 0, length, width, width};
Box(2) = {length, 0, 0, length, width, width};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }

e = 1e-5;
steel()  = Volume In BoundingBox{-e, -e, -e, length + e, width + e, width + e};
rubber() = Volume In BoundingBox{length - e, -e, -e, 2 * length + e, width + e, width + e};
left()   = Surface In BoundingBox{-e, -e, -e, e, width + e, width + e};
right()  = Surface In BoundingBox{2 * length - e, -e, -e, 2 * length + e, width + e, width + e};
top()    = Surface In BoundingBox{-e, -e, width - e, 2 * length + e, width + e, width + e};

Physical Volume("steel", 1)  = {steel()};
Physical Volume("rubber", 2) = {rubber()};
Physical Surface("left", 1)  = {left()};
Physical Surface("right", 2) = {right()};
Physical Surface("top", 3)   = {top()};

Mesh.MeshSizeMin = 0.016;
Mesh.MeshSizeMax = 0.016;
