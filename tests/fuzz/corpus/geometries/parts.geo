/* A part and
   a comment */ Include "part.geo"; Merge 'part.geo';
Point(1) = {0, 0, 0, h}; // "Save"
Printf("%g (a)", Sin(1)); General.Verbosity = 2;
Plugin(Save).Run; ListFromFile("x.csv");
//====
h = 0.5;
Include "main.geo";
