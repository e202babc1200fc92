"""Opens the STEP file of a wheel in 3D in FreeCAD, cuts it by the planes of its exported sections and compares both.

To be run by FreeCAD with a window; the variable WHEEL holds the path of the files without their endings. Says how far the
edges of the solid's sections are from those of the DXF files, and saves pictures of the solid and of its half with the
DXF files' edges.
"""

import glob
import os
import traceback

import FreeCAD
import FreeCADGui
import importDXF
import Part
from PySide2 import QtWidgets

wheel = os.environ["WHEEL"]
STEP_ALONG_EDGES = 1.0  # mm
INSIDE = 1e-4  # mm, from side faces


def picture(name, direction):
    view = FreeCADGui.activeDocument().activeView()
    getattr(view, direction)()
    FreeCADGui.SendMsgToActiveView("ViewFit")
    for _ in range(20):
        QtWidgets.QApplication.processEvents()
    view.saveImage(f"{wheel}-{name}.png", 900, 700, "White")


def kinds(things):
    names = [thing.TypeId.split("Geom")[-1] for thing in things]
    return ", ".join(f"{names.count(name)} {name}" for name in sorted(set(names)))


def edges_of_dxf(file):
    document = FreeCAD.newDocument("section")
    importDXF.insert(file, document.Name)
    document.recompute()
    edges = [edge.copy() for thing in document.Objects if hasattr(thing, "Shape") for edge in thing.Shape.Edges]
    FreeCAD.closeDocument(document.Name)
    return edges


def farthest(edges, others):
    """The largest distance of points on edges from the nearest of other ones [mm], and where it is."""
    target = Part.makeCompound(others)
    points = [point for edge in edges for point in edge.discretize(Number=max(3, int(edge.Length / STEP_ALONG_EDGES)))]
    return max((Part.Vertex(point).distToShape(target)[0], tuple(round(x, 1) for x in point)) for point in points)


def area(wires):
    return Part.makeFace(wires, "Part::FaceMakerBullseye").Area


def check_section(shape, file):
    z = float(file[len(wheel) + 2:-len(".dxf")])
    box = shape.BoundBox
    at = min(max(z, box.ZMin + INSIDE), box.ZMax - INSIDE)
    wires = shape.slice(FreeCAD.Vector(0, 0, 1), at)
    edges = edges_of_dxf(file)
    for edge in edges:
        edge.translate(FreeCAD.Vector(0, 0, at))
    loops = [Part.Wire(loop) for loop in Part.sortEdges(edges)]
    of_solid, of_file = area(wires), area(loops)
    far, where = max(farthest([edge for wire in wires for edge in wire.Edges], edges), farthest(edges, wires))
    print(f"\nFreeCAD: z = {z:g} mm, {len(wires)} and {len(loops)} loops, {of_solid:.1f} and {of_file:.1f} mm^2, "
          f"at most {far:.4f} mm apart, at x = {where[0]} mm, y = {where[1]} mm")
    for edge in edges:
        edge.translate(FreeCAD.Vector(0, 0, z - at))
    return edges


def main():
    document = FreeCAD.newDocument("step")
    solid = document.addObject("Part::Feature", "wheel")
    solid.Shape = Part.read(wheel + ".step")
    solid.ViewObject.ShapeColor = (0.23, 0.43, 0.65)
    document.recompute()
    shape = solid.Shape
    print(f"\nFreeCAD: step, {len(shape.Solids)} solid, valid {shape.isValid()}, "
          f"closed {all(shell.isClosed() for shell in shape.Shells)}, volume {shape.Volume:.0f} mm^3, faces:",
          kinds(face.Surface for face in shape.Faces))
    picture("solid", "viewIsometric")
    edges = []
    for file in sorted(glob.glob(wheel + "-z*.dxf"), key=lambda file: float(file[len(wheel) + 2:-4])):
        edges += check_section(shape, file)
    FreeCAD.setActiveDocument(document.Name)
    box = shape.BoundBox
    half = Part.makeBox(box.XLength, box.YLength, box.ZLength, FreeCAD.Vector(box.XMin, 0, box.ZMin))
    solid.Shape = shape.common(half)
    sections = document.addObject("Part::Feature", "sections")
    sections.Shape = Part.makeCompound(edges)
    sections.ViewObject.LineColor = (0.85, 0.1, 0.1)
    sections.ViewObject.LineWidth = 3
    document.recompute()
    picture("sections", "viewIsometric")


try:
    main()
except Exception:  # FreeCAD would stay open
    print("\nFreeCAD:", traceback.format_exc().replace("\n", "\nFreeCAD: "))
    os._exit(1)
os._exit(0)
