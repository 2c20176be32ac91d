If (1)
 Printf("a") >> "x";
 SystemCall "true"; Save "x"; Exit;
EndIf
v() = ShapeFromFile("/tmp/x.step");
