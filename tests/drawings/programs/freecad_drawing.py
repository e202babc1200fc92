"""Draws holes of all kinds with FreeCAD and exports them: freecadcmd freecad_drawing.py, in the folder for the files."""

import math

import FreeCAD
import Import
import importSVG
import Part
from FreeCAD import Vector

document = FreeCAD.newDocument("wheel")


def at(radius, degrees):
    return Vector(radius * math.cos(math.radians(degrees)), radius * math.sin(math.radians(degrees)), 0)


def add(name, shape):
    document.addObject("Part::Feature", name).Shape = shape


add("Circle", Part.makeCircle(30, at(270, 10)))
add("Ellipse", Part.Ellipse(at(270, 60), 35, 20).toShape())
c = at(265, 110)
right = Part.Arc(c + Vector(20, -12, 0), c + Vector(32, 0, 0), c + Vector(20, 12, 0)).toShape()
left = Part.Arc(c + Vector(-20, 12, 0), c + Vector(-32, 0, 0), c + Vector(-20, -12, 0)).toShape()
add("Slot", Part.Wire([Part.makeLine(c + Vector(-20, -12, 0), c + Vector(20, -12, 0)), right,
                       Part.makeLine(c + Vector(20, 12, 0), c + Vector(-20, 12, 0)), left]))
c = at(268, 170)
spline = Part.BSplineCurve()
spline.interpolate([c + Vector(30, 0, 0), c + Vector(5, 22, 0), c + Vector(-28, 6, 0), c + Vector(-10, -24, 0)], True)
add("Spline", spline.toShape())
add("CircleAsSpline", Part.Circle(at(270, 230), Vector(0, 0, 1), 28).toNurbs().toShape())
add("EllipseAsSpline", Part.Ellipse(at(270, 280), 33, 18).toNurbs().toShape())
c = at(265, 330)
corner = c + Vector(-30, -15, 0)
add("Polygon", Part.makePolygon([corner, c + Vector(25, -20, 0), c + Vector(20, 22, 0), corner]))
document.recompute()
Import.writeDXFObject(document.Objects, "freecad.dxf")
importSVG.export(document.Objects, "freecad.svg")
