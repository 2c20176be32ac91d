// A hoop about the z axis: mean radius R, thickness t, width w, in m. One
// layer of cells; 4 n around, m across.
R = 0.1;
t = 0.002;
w = 0.02;
n = 8;
m = 1;

Point(1) = {0, -R + t / 2, 0};
Point(2) = {0, -R - t / 2, 0};
Point(3) = {0, -R - t / 2, w};
Point(4) = {0, -R + t / 2, w};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 2;
Transfinite Curve {2, 4} = m + 1;
Transfinite Surface {1};
// Each time the end face, the volume and the sides come back.
end = 1;
For quarter In {0 : 3}
  new[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi / 2} { Surface{end}; Layers{n}; };
  end = new[0];
  volumes[] += new[1];
EndFor
Coherence;
Physical Volume("hoop") = {volumes[]};
