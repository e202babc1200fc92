"""Opens a wheel's STEP and DXF files in FreeCAD, says what is in them, and saves a picture of each.

To be run by FreeCAD with a window; the variable WHEEL holds the path of the files without their endings.
"""

import os

import FreeCAD
import FreeCADGui
import importDXF
import Part
from PySide2 import QtWidgets

wheel = os.environ["WHEEL"]


def picture(name, direction):
    view = FreeCADGui.activeDocument().activeView()
    getattr(view, direction)()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    for _ in range(20):
        QtWidgets.QApplication.processEvents()
    view.saveImage(os.path.join(os.path.dirname(wheel), name), 900, 700, "White")


def kinds(things):
    names = [thing.TypeId.split("Geom")[-1] for thing in things]
    return ", ".join(f"{names.count(name)} {name}" for name in sorted(set(names)))


document = FreeCAD.newDocument("step")
solid = document.addObject("Part::Feature", "wheel")
solid.Shape = Part.read(wheel + ".step")
solid.ViewObject.ShapeColor = (0.23, 0.43, 0.65)
document.recompute()
shape = solid.Shape
print(f"\nFreeCAD: step, {len(shape.Solids)} solid, valid {shape.isValid()}, volume {shape.Volume:.0f} mm^3, faces:",
      kinds(face.Surface for face in shape.Faces))
picture("freecad_step.png", "viewIsometric")

document = FreeCAD.newDocument("dxf")
importDXF.insert(wheel + ".dxf", "dxf")
document.recompute()
objects = [thing for thing in document.Objects if hasattr(thing, "Shape")]
for thing in objects:
    thing.ViewObject.LineColor = (0.1, 0.2, 0.5)
    thing.ViewObject.LineWidth = 2
print("\nFreeCAD: dxf, edges:", kinds(edge.Curve for thing in objects for edge in thing.Shape.Edges))
picture("freecad_dxf.png", "viewTop")
os._exit(0)
