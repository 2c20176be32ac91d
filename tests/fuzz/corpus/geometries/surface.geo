// An L-shaped block, 1 x 1 x 0.3 m with arms 0.4 m wide and its corner at the origin: it has no symmetry but one plane. Units: m.
SetFactory("OpenCASCADE");

width  = 0.4;
height = 0.3;

Box(1) = {0, 0, 0, 1, width, height};
Box(2) = {0, width, 0, width, 1 - width, height};
block() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; };

Physical Volume("block", 1) = {block()};

Mesh.MeshSizeMin = 0.4;
Mesh.MeshSizeMax = 0.4;
