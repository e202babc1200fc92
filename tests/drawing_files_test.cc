#include <fmt/format.h>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/wait.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <random>

#include "tests/run_support.h"
#include "wheelwright/cad/curves/spline.h"
#include "wheelwright/cad/drawing/chain.h"
#include "wheelwright/cad/drawing/composed_level_set.h"
#include "wheelwright/cad/drawing/drawing.h"
#include "wheelwright/cad/drawing/parts.h"
#include "wheelwright/cad/drawing/picture_outline.h"
#include "wheelwright/cad/drawing/svg_path.h"
#include "wheelwright/cad/drawing/symmetry.h"
#include "wheelwright/case/drawn_shapes.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/shape_symmetry.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright::testing {
namespace {

using std::numbers::pi;

const fs::path drawings = fs::path(WHEELWRIGHT_SOURCE_DIR) / "tests/drawings";

Drawing drawing_of(DrawingFormat format, const std::string& bytes, const DrawingOptions& options = {}) {
  DrawingResult result = read_drawing(format, bytes, options);
  for (const DrawingProblem& problem : result.problems)
    ADD_FAILURE() << problem.line << ": " << problem.problem;
  return result.value.value_or(Drawing{});
}

/// The region of a drawing as the hole of a shape.
Composition region(const Drawing& drawing) { return Composition({{Fill::hole, {drawing.outline}}}); }

double area(const DrawnOutline& outline) {
  // Of the loops, by Green's theorem along their curves, with Simpson's rule on short pieces.
  double sum = 0;
  for (const DrawnLoop& loop : outline.loops) {
    double twice = 0;
    for (const Curve& curve : loop.curves) {
      constexpr int n = 200;
      for (int i = 0; i < n; ++i) {
        const auto f = [&](double s) { return cross(curve.at(s), curve.derivative(s)); };
        twice += (f(double(i) / n) + 4 * f((i + 0.5) / n) + f((i + 1.0) / n)) / (6 * n);
      }
    }
    sum += std::abs(0.5 * twice);
  }
  return sum;
}

// --- Paths of SVG

TEST(SvgPath, RelativeCommandsAreTheAbsoluteOnes) {
  const auto absolute = parse_svg_path(
      "M10,20 L30 25 H50 V40 C51,42 53,44 50,50 S40,60 30,55 Q20 50 22 40 T12,30 A8 4 30 0 1 8,25 Z");
  const auto relative =
      parse_svg_path("m10,20 l20 5 h20 v15 c1,2 3,4 0,10 s-10,10-20,5 q-10-5-8-15 t-10-10 a8 4 30 01-4-5 z");
  ASSERT_FALSE(absolute.mistake);
  ASSERT_FALSE(relative.mistake);
  ASSERT_EQ(absolute.subpaths.size(), 1u);
  EXPECT_TRUE(absolute.subpaths[0].closed);
  ASSERT_EQ(absolute.subpaths[0].curves.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i)
    for (const double s : {0.0, 0.3, 0.7, 1.0})
      EXPECT_NEAR(distance(absolute.subpaths[0].curves[i].at(s), relative.subpaths[0].curves.at(i).at(s)), 0,
                  1e-13);
  // S and T continue with the tangent of what is before them.
  const auto& curves = absolute.subpaths[0].curves;
  for (const int i : {4, 6}) {
    const Point before = curves[i - 1].derivative(1), after = curves[i].derivative(0);
    EXPECT_NEAR(cross(before, after), 0, 1e-10);
    EXPECT_GT(dot<2>(before, after), 0);
  }
}

TEST(SvgPath, ArcsAreThoseOfTheirRadiiAndFlags) {
  // The four arcs of radius 5 between two points 6 apart: the centre is 4 above or below the chord.
  for (const bool large : {false, true})
    for (const bool sweep : {false, true}) {
      const auto path = parse_svg_path(fmt::format("M0,0A5,5,0,{:d},{:d},6,0", large, sweep));
      ASSERT_EQ(path.subpaths.size(), 1u);
      const Curve& arc = path.subpaths[0].curves[0];
      const double side = large != sweep ? 1 : -1;
      for (int i = 0; i <= 10; ++i) EXPECT_NEAR(distance(arc.at(i / 10.0), {3, side * 4}), 5, 1e-13);
      // With sweep the angle grows, in the axes of SVG.
      EXPECT_EQ(cross(arc.at(0.5) - Point{3, side * 4}, arc.derivative(0.5)) > 0, sweep);
      const double middle = arc.at(0.5)[1];
      EXPECT_NEAR(middle, side * 4 + (large ? side * 5 : -side * 5), 1e-13);
    }
  // Radii that are too small grow until they reach; a radius of 0 is a line.
  EXPECT_NEAR(std::abs(parse_svg_path("M0,0 A1,1 0 0 1 6,0").subpaths[0].curves[0].at(0.5)[1]), 3, 1e-13);
  EXPECT_EQ(parse_svg_path("M0,0 A0,1 0 0 1 6,0").subpaths[0].curves[0].at(0.5), (Point{3, 0}));
  // Radii and their turn: an ellipse turned by 90 degrees.
  const Curve turned = parse_svg_path("M0,-2 A2,1 90 0 1 0,2").subpaths[0].curves[0];
  EXPECT_NEAR(distance(turned.at(0.5), {1, 0}), 0, 1e-13);
}

TEST(SvgPath, NumbersStandAsCloseAsSvgAllows) {
  const auto path = parse_svg_path("M.5.5-1.5-.25L1e1,2E-1 +3 4M5 5 6 6");
  ASSERT_FALSE(path.mistake);
  ASSERT_EQ(path.subpaths.size(), 2u);
  EXPECT_EQ(path.subpaths[0].curves[0].start(), (Point{0.5, 0.5}));
  EXPECT_EQ(path.subpaths[0].curves[0].end(), (Point{-1.5, -0.25}));
  EXPECT_EQ(path.subpaths[0].curves[1].end(), (Point{10, 0.2}));
  EXPECT_EQ(path.subpaths[0].curves[2].end(), (Point{3, 4}));
  EXPECT_EQ(path.subpaths[1].curves[0].end(), (Point{6, 6}));
}

TEST(SvgPath, MistakesAreFoundWhereTheyAre) {
  const std::vector<std::pair<std::string, std::size_t>> wrong{
      {"L1,1", 0},          {"M1", 2},         {"M1,1 L2", 7}, {"M1,1 X2,2", 5}, {"M1,1 A1,1 0 2 0 5,5", 12},
      {"M1,1 L2,2,,3", 10}, {"M1,1 Linf,2", 6}};
  for (const auto& [data, at] : wrong) {
    const auto path = parse_svg_path(data);
    ASSERT_TRUE(path.mistake) << data;
    EXPECT_EQ(path.mistake->at, at) << data;
  }
}

TEST(SvgTransform, IsTheProductOfItsParts) {
  const auto same = [](const std::string& text, const Affine& map) {
    const auto read = parse_svg_transform(text);
    ASSERT_TRUE(read) << text;
    for (const Point& p : {Point{0, 0}, Point{1, 0}, Point{0, 1}})
      EXPECT_NEAR(distance((*read)(p), map(p)), 0, 1e-13) << text;
  };
  same("translate(3)", Affine::shift({3, 0}));
  same("matrix(1 2 3 4 5 6)", {.xx = 1, .xy = 3, .yx = 2, .yy = 4, .dx = 5, .dy = 6});
  same(" scale( 2 ) , rotate(90)", {.xx = 0, .xy = -2, .yx = 2, .yy = 0});
  same("rotate(90,1,0)", {.xx = 0, .xy = -1, .yx = 1, .yy = 0, .dx = 1, .dy = -1});
  same("skewX(45)", {.xy = 1});
  same("skewY(45)", {.yx = 1});
  for (const char* wrong : {"translate(1", "turn(3)", "scale()", "matrix(1,2,3)", "rotate(1,2)"})
    EXPECT_FALSE(parse_svg_transform(wrong)) << wrong;
}

// --- Files of drawing programs; no wheel has a symmetry

/// Whether a point of the drawing, in its own unit with y up, is drawn.
bool is_drawn(const Composition& shape, double x, double y) { return shape.is_hole({x * 1e-3, y * 1e-3}); }

TEST(Svg, InkscapeDrawingIsReadAsDisplayed) {
  const Drawing drawing = drawing_of(DrawingFormat::svg, content(drawings / "inkscape.svg"));
  EXPECT_DOUBLE_EQ(drawing.metres_per_unit, 1e-3);
  EXPECT_EQ(drawing.axle, (Point{340, 340}));
  ASSERT_EQ(drawing.outline.loops.size(), 7u);
  const Composition shape = region(drawing);
  // Inkscape's y points down: what is at the top of the screen has positive y here.
  const auto at = [&](double x, double y_down) { return is_drawn(shape, x, -y_down); };
  EXPECT_TRUE(at(280, -40));
  EXPECT_FALSE(at(280, 40));  // its mirror image
  EXPECT_TRUE(at(-270, 0));
  // The rectangle is turned clockwise by 15 degrees on the screen.
  const Point corner = Affine::rotation(15 * pi / 180)({235, 15 + 15});
  EXPECT_NEAR(shape.distance(1e-3 * Point{corner[0], -corner[1]}, 1), 0, 1e-12);
  // The circle stands at (270, 20) of a group that is turned by -90 degrees: at (20, -270).
  EXPECT_NEAR(shape.distance({0.020, 0.270}, 1), 0.022, 1e-12);
  // Its clone is turned by 140 degrees from there; the group of the original does not count.
  const Point clone = Affine::rotation(140 * pi / 180)({270, 20});
  EXPECT_NEAR(shape.distance(1e-3 * Point{clone[0], -clone[1]}, 1), 0.022, 1e-12);
  EXPECT_TRUE(is_drawn(shape, clone[0], -clone[1]));
  EXPECT_NEAR(area(drawing.outline),
              1e-6 * (2 * pi * 22 * 22 + pi * 35 * 25 + pi * 30 * 12 + 60 * 30 - (4 - pi) * 8 * 5) +
                  area({{drawing.outline.loops[0]}}) + area({{drawing.outline.loops[5]}}),
              1e-9);
}

TEST(Svg, UnitsComeFromThePage) {
  const auto unit = [](const std::string& page) {
    return read_drawing(DrawingFormat::svg,
                        "<svg xmlns=\"http://www.w3.org/2000/svg\" " + page + "><circle r=\"3\"/></svg>", {});
  };
  EXPECT_DOUBLE_EQ(unit("width='10cm' height='10cm' viewBox='0 0 100 100'").value->metres_per_unit, 1e-3);
  EXPECT_DOUBLE_EQ(unit("width='4in' height='2in' viewBox='0 0 4 2'").value->metres_per_unit, 0.0254);
  EXPECT_DOUBLE_EQ(unit("width='96mm' height='96mm'").value->metres_per_unit, 0.0254 / 96);
  EXPECT_EQ(unit("width='4in' height='2in' viewBox='10 20 4 2'").value->axle, (Point{12, 21}));
  for (const char* silent : {"", "width='100%' height='100%' viewBox='0 0 4 4'", "width='100' height='100'",
                             "width='100px' height='100px' viewBox='0 0 100 100'"}) {
    const auto result = unit(silent);
    ASSERT_FALSE(result.value) << silent;
    EXPECT_EQ(result.problems[0].key, DrawingProblem::Key::unit) << silent;
  }
}

TEST(Svg, GivenAxleAndUnitAreUsed) {
  const std::string svg = "<svg viewBox='0 0 100 100'><circle cx='70' cy='20' r='5'/></svg>";
  const Drawing drawing = drawing_of(DrawingFormat::svg, svg, {0.01, Point{40, 60}});
  const Composition shape = region(drawing);
  EXPECT_NEAR(shape.distance({0.3, 0.4}, 1), 0.05, 1e-13);
  EXPECT_TRUE(shape.is_hole({0.3, 0.4}));
}

TEST(Svg, OutlinesInOthersCutThemOut) {
  const std::string svg =
      "<svg width='10mm' height='10mm' viewBox='0 0 10 10'>"
      "<circle cx='5' cy='5' r='4'/><circle cx='5' cy='5' r='2'/><circle cx='5' cy='5' r='1'/></svg>";
  const Composition shape = region(drawing_of(DrawingFormat::svg, svg));
  EXPECT_TRUE(is_drawn(shape, 3, 0));
  EXPECT_FALSE(is_drawn(shape, 1.5, 0));
  EXPECT_TRUE(is_drawn(shape, 0.5, 0));
}

TEST(Svg, PiecesOfOneOutlineAreJoined) {
  const std::string svg =
      "<svg width='10mm' height='10mm' viewBox='0 0 10 10'><path d='M0,0 H8'/>"
      "<line x1='8' y1='8' x2='8' y2='0'/><polyline points='0,0 0,8 8,8'/></svg>";
  const Drawing drawing = drawing_of(DrawingFormat::svg, svg);
  ASSERT_EQ(drawing.outline.loops.size(), 1u);
  EXPECT_NEAR(area(drawing.outline), 64e-6, 1e-15);
}

TEST(Dxf, LibreCadDrawingIsReadAsDisplayed) {
  const Drawing drawing = drawing_of(DrawingFormat::dxf, content(drawings / "librecad.dxf"));
  EXPECT_DOUBLE_EQ(drawing.metres_per_unit, 1e-3);
  ASSERT_EQ(drawing.outline.loops.size(), 8u);
  const Composition shape = region(drawing);
  const auto is_edge = [&](double x, double y) {
    EXPECT_NEAR(shape.distance(1e-3 * Point{x, y}, 1), 0, 1e-12) << x << ' ' << y;
  };
  // The slot of lines and arcs.
  EXPECT_TRUE(is_drawn(shape, 306, 10));
  is_edge(307, 10);
  is_edge(228, 10);
  // The polyline: a bulge of 0.5 outwards at x = 140, one of -0.3 inwards at x = 110; the height of the arc
  // is the bulge times half the chord.
  is_edge(140 + 0.5 * 15, 230);
  is_edge(110 + 0.3 * 15, 230);
  EXPECT_TRUE(is_drawn(shape, 146, 230));
  EXPECT_FALSE(is_drawn(shape, 113, 230));
  // The ellipses: the ends of the axes.
  is_edge(-180 + 20, 200 + 20);
  is_edge(-180 - 8, 200 + 8);
  is_edge(-285, 0);
  EXPECT_TRUE(is_drawn(shape, -275, 0));
  EXPECT_FALSE(is_drawn(shape, -265, 0));
  // The spline begins and ends at its first and last control points; at the inner knot it is the mean of de
  // Boor.
  is_edge(-200, -150);
  const Point a{-260, -170}, b{-240, -220}, c{-160, -230};
  const Point middle = 0.25 * a + 0.5 * b + 0.25 * c;
  is_edge(middle[0], middle[1]);
  // The block: base point (10, 0), scaled by 1.5 and -1, turned by 30 degrees, placed at (0, -270).
  const auto placed = [](double x, double y) {
    return Point{0, -270} + Affine::rotation(pi / 6).linear({1.5 * (x - 10), -1 * y});
  };
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {30.0, 20.0}, {40.0, 10.0}, {15.0, 10.0}, {20.0, 0.0}})
    is_edge(placed(x, y)[0], placed(x, y)[1]);
  EXPECT_TRUE(is_drawn(shape, placed(35, 10)[0], placed(35, 10)[1]));
  // The arc that is seen from below.
  EXPECT_TRUE(is_drawn(shape, 205, -145));
  EXPECT_FALSE(is_drawn(shape, -205, -145));
  is_edge(205, -140);
}

TEST(Dxf, FreeCadDrawingIsReadAsDisplayed) {
  const DrawingResult silent = read_drawing(DrawingFormat::dxf, content(drawings / "freecad.dxf"), {});
  ASSERT_EQ(silent.problems.size(), 1u);
  EXPECT_EQ(silent.problems[0].key, DrawingProblem::Key::unit);
  const Drawing drawing = drawing_of(DrawingFormat::dxf, content(drawings / "freecad.dxf"), {1e-3, {}});
  ASSERT_EQ(drawing.outline.loops.size(), 3u);
  const Composition shape = region(drawing);
  EXPECT_TRUE(is_drawn(shape, -100, 250));
  EXPECT_TRUE(is_drawn(shape, 0, -260));
  EXPECT_TRUE(is_drawn(shape, 30, -290));
  EXPECT_NEAR(shape.distance({-0.1, 0.22}, 1), 0, 1e-12);
  // The arc of the polyline turns by 80 degrees.
  const Point from{305, 60}, to{255, 70}, chord = to - from;
  const Point right = 1 / norm<2>(chord) * Point{chord[1], -chord[0]};
  const Point top = 0.5 * (from + to) + 0.5 * norm<2>(chord) * std::tan(20 * pi / 180) * right;
  EXPECT_NEAR(shape.distance(1e-3 * top, 1), 0, 1e-12);
}

// What drawing programs themselves wrote; tests/drawings/programs/README.md tells what was drawn.

/// A file read in millimetres, with questions in them.
class WrittenByAProgram {
 public:
  /// Coordinates in the file are rounded to `rounding` [mm].
  WrittenByAProgram(const std::string& name, double rounding, const DrawingOptions& options = {})
      : drawing_(drawing_of(*drawing_format(name), content(drawings / "programs" / name), options)),
        shape_(region(drawing_)),
        rounding_(rounding) {}

  std::size_t n_loops() const { return drawing_.outline.loops.size(); }
  bool is_drawn(const Point& x) const { return shape_.is_hole(1e-3 * x); }
  void expect_edge(const Point& x) const {
    EXPECT_LE(shape_.distance(1e-3 * x, 1), 1e-3 * rounding_) << x[0] << ' ' << x[1];
  }
  /// An ellipse: all of its edge.
  void expect_ellipse(const Point& centre, double half_length, double half_width, double degrees) const {
    EXPECT_TRUE(is_drawn(centre));
    for (int i = 0; i < 24; ++i) {
      const double t = 2 * pi * (i + 0.3) / 24;
      expect_edge(
          centre +
          Affine::rotation(degrees * pi / 180).linear({half_length * std::cos(t), half_width * std::sin(t)}));
    }
  }

 private:
  Drawing drawing_;
  Composition shape_;
  double rounding_;
};

Point at_degrees(double radius, double degrees) { return polar(radius, degrees * pi / 180); }

TEST(WrittenBy, Inkscape) {
  for (const char* name : {"inkscape.svg", "inkscape_plain.svg"}) {
    SCOPED_TRACE(name);
    const WrittenByAProgram drawing(name, 1e-3);
    EXPECT_EQ(drawing.n_loops(), 6u);
    const auto seen = [](double x, double y) { return Point{x - 340, 340 - y}; };
    drawing.expect_ellipse(seen(605.9, 293.1), 30, 30, 0);
    drawing.expect_ellipse(seen(475, 106), 35, 20, -25);  // clockwise on the screen
    for (const double side : {-1, 1})
      drawing.expect_edge(seen(245, 85) + Affine::rotation(15 * pi / 180).linear({side * 30, 3}));
    for (const auto& [x, y] : {std::pair{160.0, 520.0}, {190.0, 560.0}, {150.0, 590.0}, {130.0, 550.0}})
      drawing.expect_edge(seen(160, 555) + Affine::rotation(-pi / 3).linear({x - 160, 555 - y}));
    drawing.expect_edge(seen(106, 293));
    // The square without the circle about the middle of its right side.
    EXPECT_TRUE(drawing.is_drawn(seen(380, 600)));
    EXPECT_FALSE(drawing.is_drawn(seen(405, 600)));
    drawing.expect_edge(seen(395, 600));
  }
}

TEST(WrittenBy, LibreCad) {
  const WrittenByAProgram drawing("librecad.dxf", 1e-9);
  EXPECT_EQ(drawing.n_loops(), 4u);
  drawing.expect_ellipse({265.898, 46.885}, 30, 30, 0);
  drawing.expect_edge({-112, 258});
  EXPECT_TRUE(drawing.is_drawn({-90, 250}));
  const Point inner_knot = 0.25 * Point{-245, 80} + 0.5 * Point{-292, 65} + 0.25 * Point{-280, 22};
  drawing.expect_edge(inner_knot);
  EXPECT_TRUE(drawing.is_drawn({-260, 50}));
  drawing.expect_edge({262, -130});  // on the arc
  drawing.expect_edge({227, -150.5});
  EXPECT_TRUE(drawing.is_drawn({240, -135}));
}

TEST(WrittenBy, FreeCad) {
  const WrittenByAProgram dxf("freecad.dxf", 2e-3);  // six digits
  // The rounded ends of half circles move their centres by the root of the rounding.
  const WrittenByAProgram svg("freecad.svg", 0.1, {{}, Point{301.79402, 266.936288}});
  for (const WrittenByAProgram* drawing : {&dxf, &svg}) {
    EXPECT_EQ(drawing->n_loops(), 7u);
    drawing->expect_ellipse(at_degrees(270, 10), 30, 30, 0);
    drawing->expect_ellipse(at_degrees(270, 60), 35, 20, 0);
    const Point slot = at_degrees(265, 110), spline = at_degrees(268, 170), corner = at_degrees(265, 330);
    for (const Point& x : {Point{32, 0}, Point{-32, 0}, Point{0, 12}, Point{5, -12}})
      drawing->expect_edge(slot + x);
    for (const Point& x : {Point{30, 0}, Point{5, 22}, Point{-28, 6}, Point{-10, -24}})
      drawing->expect_edge(spline + x);
    for (const Point& x : {Point{-30, -15}, Point{25, -20}, Point{20, 22}}) drawing->expect_edge(corner + x);
    for (const Point& x : {slot, spline, corner}) EXPECT_TRUE(drawing->is_drawn(x));
  }
  // FreeCAD approximates rational splines before it writes them, by 2 micrometres at best.
  const WrittenByAProgram approximated("freecad.dxf", 0.02);
  approximated.expect_ellipse(at_degrees(270, 230), 28, 28, 0);
  approximated.expect_ellipse(at_degrees(270, 280), 33, 18, 0);
}

TEST(WrittenBy, Ezdxf) {
  const WrittenByAProgram drawing("ezdxf.dxf", 1e-6);
  EXPECT_EQ(drawing.n_loops(), 4u);  // without the hatch
  drawing.expect_ellipse(at_degrees(270, 15), 30, 30, 0);
  drawing.expect_ellipse(at_degrees(270, 75), 25, 25, 0);
  drawing.expect_ellipse(at_degrees(265, 250), 30, 30, 0);
  const Point centre = at_degrees(265, 140);
  for (const double t : {0.2, 0.5, 0.7}) {
    const double w0 = (1 - t) * (1 - t), w1 = 3 * 2 * t * (1 - t), w2 = t * t;
    drawing.expect_edge(centre +
                        1 / (w0 + w1 + w2) * (w0 * Point{30, 0} + w1 * Point{0, 40} + w2 * Point{-30, 0}));
  }
}

TEST(Spline, PiecesAreTheCurveOfItsBasisFunctions) {
  // The basis functions by their recursion (Cox and de Boor).
  const std::function<double(const std::vector<double>&, int, int, double)> basis =
      [&](const std::vector<double>& knots, int i, int p, double t) -> double {
    if (p == 0) return t >= knots[i] && t < knots[i + 1];
    double value = 0;
    if (knots[i + p] > knots[i])
      value += (t - knots[i]) / (knots[i + p] - knots[i]) * basis(knots, i, p - 1, t);
    if (knots[i + p + 1] > knots[i + 1])
      value += (knots[i + p + 1] - t) / (knots[i + p + 1] - knots[i + 1]) * basis(knots, i + 1, p - 1, t);
    return value;
  };
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const int degree : {1, 2, 3}) {
    std::vector<Point> points;
    for (int i = 0; i < 8; ++i) points.push_back({number(random), number(random)});
    std::vector<double> knots{0};
    while (knots.size() < points.size() + degree + 1)
      knots.push_back(knots.back() + 0.2 + std::abs(number(random)));
    const auto pieces = spline_pieces(degree, knots, points);
    ASSERT_EQ(pieces.size(), points.size() - degree);
    for (std::size_t k = 0; k < pieces.size(); ++k)
      for (const double s : {0.01, 0.3, 0.9}) {
        const double t = knots[degree + k] + s * (knots[degree + k + 1] - knots[degree + k]);
        Point expected{};
        for (std::size_t i = 0; i < points.size(); ++i)
          expected = expected + basis(knots, static_cast<int>(i), degree, t) * points[i];
        EXPECT_NEAR(distance(pieces[k].at(s), expected), 0, 1e-12);
      }
  }
}

TEST(Spline, RationalPiecesAreTheCurveOfTheirWeights) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const int degree : {1, 2, 3})
    for (int k = 0; k < 20; ++k) {
      std::vector<Point> points;
      std::vector<double> weights, knots(degree + 1, 0.0);
      for (int i = 0; i < degree + 3; ++i) {
        points.push_back({number(random), number(random)});
        weights.push_back(std::exp(2 * number(random)));
      }
      for (int i = 1; i < 3; ++i) knots.push_back(i);
      knots.insert(knots.end(), degree + 1, 3.0);
      // The polynomial spline of each homogeneous coordinate, as the first coordinate of a curve.
      const auto coordinate = [&](const auto& value) {
        std::vector<Point> graph;
        for (std::size_t i = 0; i < points.size(); ++i) graph.push_back({value(i), 0});
        return spline_pieces(degree, knots, graph);
      };
      const auto x = coordinate([&](std::size_t i) { return weights[i] * points[i][0]; }),
                 y = coordinate([&](std::size_t i) { return weights[i] * points[i][1]; }),
                 w = coordinate([&](std::size_t i) { return weights[i]; });
      std::vector<Curve> pieces;
      for (const Curve& curve : rational_spline_pieces(degree, knots, points, weights))
        std::ranges::copy(simple_pieces(curve), std::back_inserter(pieces));
      for (std::size_t i = 0; i + 1 < pieces.size(); ++i) EXPECT_EQ(pieces[i].end(), pieces[i + 1].start());
      for (std::size_t piece = 0; piece < x.size(); ++piece)
        for (const double s : {0.0, 0.13, 0.5, 0.81, 1.0}) {
          const double weight = w[piece].at(s)[0];
          const Point exact{x[piece].at(s)[0] / weight, y[piece].at(s)[0] / weight};
          double nearest = 1;
          for (const Curve& curve : pieces) nearest = std::min(nearest, curve.nearest(exact).distance2);
          EXPECT_LE(std::sqrt(nearest), 3e-8) << degree << ' ' << k;
        }
    }
}

// --- Pictures

/// A grey picture as PNG, dark where `is_dark` says so at the centre of a pixel.
std::string png(int columns, int rows, const std::function<bool(double, double)>& is_dark) {
  std::vector<std::uint8_t> grey;
  // The share of 4 x 4 samples that is dark, as a drawing program smooths edges.
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      int dark = 0;
      for (int i = 0; i < 16; ++i) dark += is_dark(column + (i % 4 + 0.5) / 4, row + (i / 4 + 0.5) / 4);
      grey.push_back(static_cast<std::uint8_t>(255 - 255 * dark / 16));
    }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = columns;
  image.height = rows;
  image.format = PNG_FORMAT_GRAY;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, grey.data(), 0, nullptr), 0);
  bytes.resize(size);
  return bytes;
}

TEST(Picture, WheelIsReadAsDisplayed) {
  // A disc to the right of the axle and above it, and a ring to the left.
  const int n = 400;
  const double pixel = 0.7 / n;
  const std::string bytes = png(n, n, [&](double column, double row) {
    const double x = (column - n / 2) * pixel, y = (n / 2 - row) * pixel;
    const double left = std::hypot(x + 0.27, y);
    return std::hypot(x - 0.2, y - 0.18) < 0.04 || (left < 0.05 && left > 0.02);
  });
  const auto picture = read_png(bytes);
  ASSERT_TRUE(picture.value);
  const Composition shape({{Fill::hole, {wheel_outline(*picture.value, 0.5, 0.7)}}});
  EXPECT_TRUE(shape.is_hole({0.2, 0.18}));
  EXPECT_FALSE(shape.is_hole({0.2, -0.18}));
  EXPECT_FALSE(shape.is_hole({-0.27, 0}));
  EXPECT_TRUE(shape.is_hole({-0.235, 0}));
  EXPECT_NEAR(shape.distance({0.2, 0.18}, 1), 0.04, 0.5 * pixel);
  EXPECT_NEAR(shape.distance({-0.27, 0}, 1), 0.02, 0.5 * pixel);
  EXPECT_NEAR(shape.distance({-0.27, 0.1}, 1), 0.05, 0.5 * pixel);
}

TEST(Picture, SectorIsRepeatedAroundTheWheel) {
  // The hole crosses the side of the picture.
  const int columns = 120, rows = 100, count = 5;
  const double inner = 0.2, outer = 0.34, middle = 0.28, azimuth = 0.05, radius = 0.04;
  const std::string bytes = png(columns, rows, [&](double column, double row) {
    const double r = outer - row / rows * (outer - inner), a = column / columns * 2 * pi / count;
    const Point x = polar(r, a);
    return distance(x, polar(middle, azimuth)) < radius ||
           distance(x, polar(middle, azimuth + 2 * pi / count)) < radius;
  });
  const auto picture = read_png(bytes);
  ASSERT_TRUE(picture.value);
  const Composition shape({{Fill::hole, {ring_outline(*picture.value, 0.5, count, inner, outer)}}});
  const double pixel = 2 * pi * outer / count / columns;
  for (int i = 0; i < count; ++i) {
    const Point centre = polar(middle, azimuth + 2 * pi * i / count);
    EXPECT_TRUE(shape.is_hole(centre));
    EXPECT_NEAR(shape.distance(centre, 1), radius, 0.5 * pixel);
    EXPECT_FALSE(shape.is_hole(polar(middle, -2 * azimuth - 0.1 + 2 * pi * i / count)));
  }
  EXPECT_TRUE(repeats(shape, count, pixel));
  EXPECT_FALSE(repeats(shape, 2 * count, pixel));
}

TEST(Picture, PatternsThatTouchAtCornersStayClosedOutlines) {
  std::mt19937 random(4);
  for (int k = 0; k < 20; ++k) {
    std::vector<bool> dark;
    for (int i = 0; i < 64; ++i) dark.push_back(random() % 2);
    const auto is_dark = [&](double column, double row) {
      return dark[static_cast<int>(column) + 8 * static_cast<int>(row)];
    };
    const auto picture = read_png(png(8, 8, is_dark));
    const DrawnOutline outline = wheel_outline(*picture.value, 0.4, 8);
    EXPECT_TRUE(crossings(outline, 5).empty());
    const Composition shape({{Fill::hole, {outline}}});
    for (int i = 0; i < 64; ++i)
      EXPECT_EQ(shape.is_hole({i % 8 - 3.5, 3.5 - i / 8}), is_dark(i % 8 + 0.5, i / 8 + 0.5));
  }
}

// --- Repetitions

std::vector<int> repetitions(const Composition& shape, int most, double tolerance) {
  std::vector<int> result{1};
  for (int n = 2; n <= most; ++n)
    if (repeats(shape, n, tolerance)) result.push_back(n);
  return result;
}

TEST(Symmetry, FindsTheNumbersOfEqualSectors) {
  const auto wheel = [](const std::vector<double>& azimuths) {
    Figure figure{Fill::hole, {}};
    for (const double azimuth : azimuths)
      figure.outlines.push_back(slot_outline(polar_frame(0.27, azimuth, 0.5), 0.05, 0.02));
    return Composition({figure});
  };
  std::vector<double> twelve, two_of_six;
  for (int i = 0; i < 12; ++i) twelve.push_back(2 * pi * i / 12);
  for (int i = 0; i < 6; ++i)
    for (const double offset : {0.1, 0.4}) two_of_six.push_back(2 * pi * i / 6 + offset);
  EXPECT_EQ(repetitions(wheel(twelve), 50, 1e-5), (std::vector{1, 2, 3, 4, 6, 12}));
  EXPECT_EQ(repetitions(wheel(two_of_six), 50, 1e-5), (std::vector{1, 2, 3, 6}));
  EXPECT_EQ(repetitions(wheel({0.3}), 50, 1e-5), (std::vector{1}));
  // A turn by less than the tolerance is no repetition.
  EXPECT_EQ(repetitions(wheel({0.3}), 2000, 5e-3), (std::vector{1}));
}

TEST(Symmetry, DistinguishesMaterialFromHoles) {
  // Four quarters of an annulus, of which the second and the fourth are filled again: the edges repeat four
  // times.
  const auto quarter = [](int i) {
    DrawnLoop loop = closed_loop({Curve::circle_arc({}, 0.3, pi / 2 * i, pi / 2 * (i + 1)),
                                  Curve::line(polar(0.3, pi / 2 * (i + 1)), polar(0.22, pi / 2 * (i + 1))),
                                  Curve::circle_arc({}, 0.22, pi / 2 * (i + 1), pi / 2 * i)},
                                 "");
    return DrawnOutline{{loop}};
  };
  Figure rings{Fill::hole, {circle_outline({}, 0.3)}}, inside{Fill::material, {circle_outline({}, 0.22)}};
  EXPECT_TRUE(repeats(Composition({rings, inside}), 7, 1e-5));
  const Composition quarters({rings, inside, {Fill::material, {quarter(1), quarter(3)}}});
  EXPECT_TRUE(repeats(quarters, 2, 1e-5));
  EXPECT_FALSE(repeats(quarters, 4, 1e-5));
}

TEST(Symmetry, ReportsTheLargestDistanceAndItsPlace) {
  // One of twelve circles is 3 mm farther out: turned by any multiple of 30 degrees it is off by that.
  const double off = 3e-3;
  const Point odd = polar(0.27 + off, 2 * pi * 5 / 12);
  Figure figure{Fill::hole, {}};
  for (int i = 0; i < 12; ++i)
    figure.outlines.push_back(
        circle_outline(Affine::shift(polar(0.27 + (i == 5 ? off : 0), 2 * pi * i / 12)), 0.02));
  const Composition wheel({figure});
  for (const int n : {2, 3, 12}) {
    const Asymmetry found = asymmetry(wheel, n, 1);
    EXPECT_NEAR(found.distance, off, 1e-2 * off);  // four points of each curve are compared
    // The point is on the odd circle, or comes to it by the turn.
    double nearest = 1;
    for (int k = 0; k < n; ++k)
      nearest = std::min(nearest, distance(Affine::rotation(2 * pi * k / n)(found.at), odd));
    EXPECT_NEAR(nearest, 0.02, 1.01 * off);
  }
  EXPECT_FALSE(repeats(wheel, 12, 0.98 * off));
  EXPECT_TRUE(repeats(wheel, 12, 1.01 * off));
  EXPECT_EQ(asymmetry(wheel, 12, 0.5 * off).distance, 0.5 * off);
}

// --- In a case

class DrawingInACase : public TemporaryFolder {
 protected:
  void write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder() / name, std::ios::binary) << bytes;
  }
  CaseResult read(const std::string& text) {
    write("case.toml", text);
    return read_case(folder() / "case.toml");
  }
};

const std::string one_hole =
    "<svg width='680mm' height='680mm' viewBox='-340 -340 680 680'>\n"
    "<circle cx='200' cy='-170' r='35'/>\n</svg>\n";

TEST_F(DrawingInACase, IsTheShapeThatItShows) {
  write("hole.svg", one_hole);
  const CaseResult drawn =
      read("[wheel]\nsectors = 16\n[[shape.file]]\npath = \"hole.svg\"\ncount = 16\nphase = 5\n");
  ASSERT_TRUE(drawn.value) << drawn.problems[0].text();
  const double azimuth = std::atan2(170, 200) * 180 / pi + 5;
  const CaseResult ring =
      read(fmt::format("[[holes.ring]]\ncount = 16\ncenter_radius = {}\nradius = 0.035\nphase = {}\n",
                       std::hypot(0.2, 0.17), azimuth));
  ASSERT_TRUE(ring.value);
  const auto a = initial_shape<2>(*drawn.value), b = initial_shape<2>(*ring.value);
  for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_NEAR(a.values[i], b.values[i], 1e-12);
}

TEST_F(DrawingInACase, NonRepeatingOneIsRefusedWithFittingSectors) {
  std::string svg = "<svg width='680mm' height='680mm' viewBox='-340 -340 680 680'>";
  for (int i = 0; i < 12; ++i)
    svg += fmt::format("<circle cx='270' cy='0' r='30' transform='rotate({})'/>", 30 * i);
  write("twelve.svg", svg + "</svg>");
  const auto fitting = [&](int sectors) {
    return read(fmt::format(
        "[wheel]\nsectors = {}\n[grid]\nangular_cells = {}\n[[shape.file]]\npath = \"twelve.svg\"\n", sectors,
        48 * sectors));
  };
  for (const int sectors : {1, 2, 3, 4, 6, 12}) EXPECT_TRUE(fitting(sectors).value) << sectors;
  const auto refused = fitting(8).problems;
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_EQ(refused[0].key, "wheel.sectors");
  EXPECT_TRUE(refused[0].remedy.ends_with(": 1, 2, 3, 4, 6, 12")) << refused[0].remedy;
  EXPECT_FALSE(fitting(24).value);
}

/// A whole wheel with straight spokes as SVG; spoke i is turned by offsets[i] degrees.
std::string spoked_wheel(const std::vector<double>& offsets) {
  std::string svg =
      "<svg width='680mm' height='680mm' viewBox='-340 -340 680 680'>\n<circle r='340'/><circle r='200'/>\n";
  const double spacing = 360.0 / offsets.size();
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const auto corner = [&](double radius, double degrees) {
      const Point p = polar(radius, (i * spacing + degrees) * pi / 180);
      return fmt::format("{},{} ", p[0], -p[1]);
    };
    const double from = offsets[i] + 2, to = offsets[i + 1 < offsets.size() ? i + 1 : 0] + spacing - 2;
    svg += "<polygon points='" + corner(220, from) + corner(220, to) + corner(315, to) + corner(315, from) +
           "'/>\n";
  }
  return svg + "</svg>";
}

const std::string whole_wheel =
    "[[shape.annulus]]\n[[shape.file]]\nas = \"material\"\npath = \"wheel.svg\"\n";

TEST_F(DrawingInACase, OfAllMaterialRepeatsAsItsMaterialDoes) {
  write("wheel.svg", spoked_wheel(std::vector<double>(18, 0)));
  const auto with_sectors = [&](int sectors) {
    return read(fmt::format("[wheel]\nsectors = {}\n[grid]\nangular_cells = {}\n", sectors, 24 * sectors) +
                whole_wheel);
  };
  for (const int sectors : {1, 2, 3, 6, 9, 18}) EXPECT_TRUE(with_sectors(sectors).value) << sectors;
  for (const int sectors : {4, 5, 12, 36}) {
    const auto refused = with_sectors(sectors).problems;
    ASSERT_EQ(refused.size(), 1u) << sectors;
    EXPECT_EQ(refused[0].key, "wheel.sectors");
    EXPECT_TRUE(refused[0].remedy.ends_with(": 1, 2, 3, 6, 9, 18")) << refused[0].remedy;
  }
}

TEST_F(DrawingInACase, OfPixelsThatAreMaterialRepeatsAsItsMaterialDoes) {
  write("wheel.png", png(300, 300, [&](double column, double row) {
          const double x = column - 150, y = 150 - row, radius = std::hypot(x, y) / 150 * 0.34;
          return radius > 0.2 && (radius < 0.22 || radius > 0.315 || std::cos(6 * std::atan2(y, x)) > 0);
        }));
  const auto with_sectors = [&](int sectors) {
    return read(
        fmt::format("[wheel]\nsectors = {}\n[[shape.annulus]]\n[[shape.picture]]\nas = "
                    "\"material\"\npath = \"wheel.png\"\nwidth = 0.68\n",
                    sectors));
  };
  for (const int sectors : {1, 2, 3, 6}) EXPECT_TRUE(with_sectors(sectors).value) << sectors;
  for (const int sectors : {4, 8, 12}) EXPECT_FALSE(with_sectors(sectors).value) << sectors;
}

TEST_F(DrawingInACase, GivesTheNumberOfSectorsWhereTheCaseDoesNot) {
  const std::string grid = "[grid]\nangular_cells = 360\n";
  const auto sectors = [&](const std::string& text) {
    const CaseResult result = read(grid + text);
    for (const Diagnostic& problem : result.problems) ADD_FAILURE() << problem.text();
    return result.value ? result.value->wheel.sectors : 0;
  };
  write("wheel.svg", spoked_wheel(std::vector<double>(18, 0)));
  EXPECT_EQ(sectors(whole_wheel), 18);
  // Other counts divide it.
  EXPECT_EQ(sectors(whole_wheel + "[[shape.circle]]\ncount = 12\ncenter_radius = 0.27\nradius = 0.01\n"), 6);
  write("twelve.svg", spoked_wheel(std::vector<double>(12, 0)));
  EXPECT_EQ(sectors(whole_wheel + "[[shape.file]]\nas = \"material\"\npath = \"twelve.svg\"\n"), 6);
  write("hole.svg", one_hole);
  EXPECT_EQ(sectors("[[shape.file]]\npath = \"hole.svg\"\ncount = 15\n"), 15);
  // Without repetition the whole ring is one sector.
  EXPECT_EQ(sectors("[[shape.file]]\npath = \"hole.svg\"\n"), 1);
  // What is round fits any number, so that the others decide.
  write("round.svg",
        "<svg width='680mm' height='680mm' viewBox='-340 -340 680 680'><circle r='300'/>"
        "<circle r='240'/></svg>");
  const std::string band = "[[shape.annulus]]\n[[shape.file]]\nas = \"material\"\npath = \"round.svg\"\n",
                    spokes = "[[shape.spoke]]\ncount = 20\nthickness = 0.01\n";
  EXPECT_EQ(sectors(band + spokes), 20);
  EXPECT_FALSE(read(spokes).value);  // without a drawing there are 16 sectors
}

TEST_F(DrawingInACase, NearlyRepeatingOneGivesAWarningOrIsRefused) {
  const auto spokes = [&](double off) {
    std::vector<double> offsets(18, 0);
    offsets[7] = off / 0.315 * 180 / pi;  // at the ends of the spokes
    write("wheel.svg", spoked_wheel(offsets));
    return read("[wheel]\nsectors = 18\n[grid]\nangular_cells = 396\n" + whole_wheel);
  };
  EXPECT_TRUE(asymmetry_warnings(*spokes(0).value).empty());
  const CaseResult hand_made = spokes(0.2e-3);
  ASSERT_TRUE(hand_made.value);
  const auto told = asymmetry_warnings(*hand_made.value);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("0.2 mm"), std::string::npos) << told[0];
  EXPECT_FALSE(spokes(3e-3).value);
}

TEST_F(DrawingInACase, IsCopiedIntoTheRunsFolderWhichResumesWithoutTheOriginal) {
  write("hole.svg", one_hole);
  const std::string text =
      "[wheel]\nsectors = 8\n[load]\npositions = 2\n[grid]\nradial_cells = 8\nangular_cells = 96\n"
      "tread_levels = 0\n[[shape.file]]\npath = \"hole.svg\"\ncount = 8\n[optimizer]\niterations = "
      "{}\nrim_band = 0.0175\ntread_band = 0.035\n"
      "[output]\nfolder = \"run\"\ncheckpoint_seconds = 0\n";
  const auto program = fs::read_symlink("/proc/self/exe").parent_path() / "wheelwright";
  const auto run = [&](const std::string& arguments) {
    return std::system(
        fmt::format("cd '{}' && '{}' {} >out.txt 2>&1", folder().string(), program.string(), arguments)
            .c_str());
  };
  write("case.toml", fmt::format(fmt::runtime(text), 4));
  ASSERT_EQ(run("run case.toml"), 0) << content(folder() / "out.txt");
  fs::rename(folder() / "run", folder() / "straight");
  write("case.toml", fmt::format(fmt::runtime(text), 2));
  ASSERT_EQ(run("run case.toml"), 0);
  EXPECT_EQ(content(folder() / "run/drawings/drawing_1.svg"), one_hole);
  fs::remove(folder() / "hole.svg");
  ASSERT_EQ(run("resume run --iterations 4"), 0) << content(folder() / "out.txt");
  expect_equal_results(folder() / "straight", folder() / "run");
  // Another drawing in the folder is refused.
  write("run/drawings/drawing_1.svg", one_hole + " ");
  EXPECT_EQ(WEXITSTATUS(run("resume run --iterations 6")), 2);
  EXPECT_NE(content(folder() / "out.txt").find("checksum"), std::string::npos);
}

// --- Bad files

struct BadFile {
  std::string name, bytes;
  int line;          ///< of the problem; 0 if it has none
  std::string key;   ///< of the case to which the problem belongs
  std::string more;  ///< keys of the shape
};

std::string svg(const std::string& inside) {
  return "<svg width='680mm' height='680mm' viewBox='-340 -340 680 680'>\n" + inside + "\n</svg>\n";
}

std::string dxf(const std::string& entities, int units = 4) {
  return fmt::format(
      "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}"
      "0\nENDSEC\n0\nEOF\n",
      units, entities);
}

std::vector<BadFile> bad_svg_files() {
  const std::string path = "path";
  const std::string circle = "<circle cx='270' cy='0' r='20'/>";
  std::string many = "<path d='M0,0";
  for (int i = 0; i < 120000; ++i) many += " 1,1 2,0";
  std::string deep;
  for (int i = 0; i < 200; ++i) deep += "<g>";
  deep += circle;
  for (int i = 0; i < 200; ++i) deep += "</g>";
  return {
      {"open.svg", svg("<path d='M 250,0 L 290,0 L 290,20'/>"), 2, path, ""},
      {"crossing.svg", svg(circle + "\n<path d='M250,50 L290,90 L290,50 L250,90 Z'/>"), 3, path, ""},
      {"overlapping.svg", svg(circle + "\n<circle cx='290' cy='0' r='20'/>"), 2, path, ""},
      {"twice.svg", svg(circle + "\n" + circle), 2, path, ""},
      {"empty.svg", svg(""), 0, path, ""},
      {"nothing.svg", "", 1, path, ""},
      {"no_xml.svg", "width = 3\n", 2, path, ""},
      {"cut_off.svg", svg(circle).substr(0, 70), 2, path, ""},
      {"html.svg", "<html>\n<body/></html>", 1, path, ""},
      {"outside.svg", svg("\n<circle cx='400' cy='0' r='20'/>"), 5, "shape.file[1]", ""},
      {"in_the_rim.svg", svg("<circle cx='210' cy='0' r='20'/>"), 5, "shape.file[1]", ""},
      {"huge.svg", "<svg width='680m' height='680m' viewBox='-340 -340 680 680'>" + circle + "</svg>", 5,
       "shape.file[1]", ""},
      {"tiny.svg", svg("<circle cx='0.27' cy='0' r='0.02'/>"), 5, "shape.file[1]", ""},
      {"no_unit.svg", "<svg viewBox='-340 -340 680 680'>" + circle + "</svg>", 5, "shape.file[1].unit", ""},
      {"other_unit.svg", svg(circle), 8, "shape.file[1].unit", "unit = \"in\"\n"},
      {"no_page.svg", "<svg>" + circle + "</svg>", 5, "shape.file[1].axle", "unit = \"mm\"\n"},
      {"no_path.svg", svg("<path d='M 250,0 L 290,x'/>"), 2, path, ""},
      {"text.svg", svg(circle + "\n<text>hole</text>"), 3, path, ""},
      {"image.svg", svg(circle + "\n<image href='wheel.png'/>"), 3, path, ""},
      {"transform.svg", svg("<g transform='turn(3)'>" + circle + "</g>"), 2, path, ""},
      {"negative.svg", svg("<circle cx='270' cy='0' r='-20'/>"), 2, path, ""},
      {"missing_clone.svg", svg(circle + "\n<use href='#other'/>"), 3, path, ""},
      {"clone_of_itself.svg", svg("<g id='a'>\n<use href='#a'/></g>"), 3, path, ""},
      {"stretched.svg", "<svg width='680mm' height='600mm' viewBox='-340 -340 680 680'>" + circle + "</svg>",
       1, path, ""},
      {"deep.svg", svg(deep), 2, path, ""},
      {"many.svg", svg(many + "Z'/>"), 2, path, ""},
      {"infinite.svg", svg("<g transform='scale(1e300)'>\n<circle cx='1e300' cy='0' r='1'/></g>"), 3, path,
       ""},
      {"not_in_sectors.svg", svg(circle), 2, "wheel.sectors", "count = 3\n"},
  };
}

std::vector<BadFile> bad_dxf_files() {
  const std::string path = "path";
  return {
      {"open.dxf", dxf("0\nLINE\n10\n250\n20\n0\n11\n290\n21\n0\n"), 15, path, ""},
      {"branching.dxf",
       dxf("0\nLINE\n10\n250\n20\n0\n11\n290\n21\n0\n0\nLINE\n10\n290\n20\n0\n11\n290\n21\n20\n"
           "0\nLINE\n10\n290\n20\n0\n11\n250\n21\n0\n"),
       15, path, ""},
      {"no_unit.dxf", dxf("0\nCIRCLE\n10\n270\n20\n0\n40\n20\n", 0), 5, "shape.file[1].unit", ""},
      {"binary.dxf", "AutoCAD Binary DXF\r\n\x1a", 1, path, ""},
      {"no_groups.dxf", "0\nSECTION\n2\nHEADER\nhello\nworld\n", 5, path, ""},
      {"cut_off.dxf", dxf("").substr(0, 50), 13, path, ""},
      {"no_entities.dxf", "0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nEOF\n", 0, path, ""},
      {"no_block.dxf", dxf("0\nINSERT\n2\nwindow\n10\n0\n20\n0\n"), 15, path, ""},
      {"region.dxf", dxf("0\nREGION\n1\nxyz\n"), 15, path, ""},
      {"radius.dxf", dxf("0\nCIRCLE\n10\n270\n20\n0\n40\nr20\n"), 15, path, ""},
      {"nan.dxf", dxf("0\nCIRCLE\n10\n270\n20\n0\n40\nnan\n"), 15, path, ""},
      {"infinite.dxf", dxf("0\nLINE\n10\n250\n20\n0\n11\n-inf\n21\n0\n"), 15, path, ""},
      {"vertex.dxf", dxf("0\nPOLYLINE\n70\n1\n0\nVERTEX\n10\n250\n20\n1e999\n0\nVERTEX\n10\n1\n20\n1\n"), 19,
       path, ""},
      {"no_radius.dxf",
       dxf("0\nCIRCLE\n10\n270\n20\n0\n40\n20\n0\nARC\n10\n270\n20\n50\n40\n0\n50\n0\n51\n90\n"), 23, path,
       ""},
      {"spline.dxf", dxf("0\nSPLINE\n71\n3\n40\n0\n40\n1\n10\n250\n20\n0\n"), 15, path, ""},
      {"rational.dxf",
       dxf("0\nSPLINE\n71\n1\n40\n0\n40\n0\n40\n1\n40\n1\n10\n250\n20\n0\n10\n290\n20\n0\n41\n1\n41\n-2\n"),
       15, path, ""},
      {"weightless.dxf",
       dxf("0\nSPLINE\n71\n1\n40\n0\n40\n0\n40\n1\n40\n1\n10\n250\n20\n0\n10\n290\n20\n0\n41\n1\n41\n0\n0\nCI"
           "RCLE\n10\n270\n20\n0\n"
           "40\n20\n"),
       15, path, ""},
      {"tilted.dxf", dxf("0\nCIRCLE\n10\n270\n20\n0\n40\n20\n210\n1\n220\n0\n230\n0\n"), 15, path, ""},
      {"in_metres.dxf", dxf("0\nCIRCLE\n10\n270\n20\n0\n40\n20\n", 6), 5, "shape.file[1]", ""},
      {"crossing.dxf", dxf("0\nCIRCLE\n10\n270\n20\n0\n40\n20\n0\nCIRCLE\n10\n290\n20\n0\n40\n20\n"), 15,
       path, ""},
  };
}

std::vector<BadFile> other_bad_files() {
  const std::string path = "path";
  std::string cut = png(20, 20, [](double x, double y) { return std::hypot(x - 10, y - 10) < 5; });
  cut.resize(cut.size() / 2);
  return {
      {"other_format.step", "ISO-10303-21;\n", 6, "shape.file[1].path", ""},
      {"cut_off.png", cut, 0, path, "width = 0.7\n"},
      {"no_png.png", "GIF89a", 0, path, "width = 0.7\n"},
      {"no_width.png", png(20, 20, [](double x, double y) { return std::hypot(x - 18, y - 10) < 1; }), 5,
       "shape.picture[1]", ""},
      {"dark.png", png(20, 20, [](double, double) { return true; }), 5, "shape.picture[1]",
       "width = 0.7\ncount = 16\n"},
  };
}

std::vector<BadFile> bad_files() {
  std::vector<BadFile> all;
  for (const auto& files : {bad_svg_files(), bad_dxf_files(), other_bad_files()})
    all.insert(all.end(), files.begin(), files.end());
  return all;
}

std::string array_of(const BadFile& bad) {
  return bad.name.ends_with(".png") ? "shape.picture" : "shape.file";
}

/// A case with the file as its only shape.
std::string case_of(const BadFile& bad) {
  const bool counts = array_of(bad) == "shape.file" && bad.more.find("count") == std::string::npos;
  return fmt::format("[wheel]\nsectors = 16\n[grid]\nangular_cells = 384\n[[{}]]\npath = \"{}\"\n{}{}",
                     array_of(bad), bad.name, counts ? "count = 16\n" : "", bad.more);
}

TEST_F(DrawingInACase, BadFilesAreRefusedWithTheirPlace) {
  const auto files = bad_files();
  EXPECT_GE(files.size(), 30u);
  for (const BadFile& bad : files) {
    SCOPED_TRACE(bad.name);
    write(bad.name, bad.bytes);
    const CaseResult result = read(case_of(bad));
    EXPECT_FALSE(result.value);
    ASSERT_FALSE(result.problems.empty());
    const Diagnostic& first = result.problems[0];
    const bool in_drawing = bad.key == "path";
    EXPECT_EQ(first.file, (folder() / (in_drawing ? bad.name : "case.toml")).string()) << first.text();
    EXPECT_EQ(first.line, bad.line) << first.text();
    EXPECT_EQ(first.key, in_drawing ? array_of(bad) + "[1].path" : bad.key) << first.text();
    EXPECT_FALSE(first.problem.empty());
  }
}

TEST_F(DrawingInACase, BadFilesExitWithCode2AndWriteNothing) {
  const auto program = fs::read_symlink("/proc/self/exe").parent_path() / "wheelwright";
  const auto code = [&](const std::string& command) {
    return WEXITSTATUS(std::system(fmt::format("cd '{}' && '{}' {} case.toml >out.txt 2>&1",
                                               folder().string(), program.string(), command)
                                       .c_str()));
  };
  for (const BadFile& bad : bad_files()) {
    SCOPED_TRACE(bad.name);
    write(bad.name, bad.bytes);
    write("case.toml", case_of(bad));
    EXPECT_EQ(code("check"), 2);
    const bool in_drawing = bad.key == "path";
    const std::string place =
        (in_drawing ? bad.name : "case.toml") + (bad.line ? fmt::format(":{}:", bad.line) : ":");
    EXPECT_NE(content(folder() / "out.txt").find(place), std::string::npos) << content(folder() / "out.txt");
  }
  write("open.svg", svg("<path d='M 250,0 L 290,0 L 290,20'/>"));
  write("case.toml", "[[shape.file]]\npath = \"open.svg\"\ncount = 16\n");
  for (const char* command : {"run", "analyze", "verify", "compare", "export"})
    EXPECT_EQ(code(command), 2) << command;
  EXPECT_FALSE(fs::exists(folder() / "runs"));
}

/// The remedies of all problems.
std::string remedies(const CaseResult& result) {
  std::string all;
  for (const Diagnostic& problem : result.problems) all += problem.remedy + '\n';
  return all;
}

/// A circle as a DXF file. `unit`: 0 none, 1 inch, 4 millimetre, 5 centimetre, 6 metre.
std::string circle_dxf(double x, double radius, int unit) {
  return dxf(fmt::format("0\nCIRCLE\n10\n{}\n20\n0\n40\n{}\n", x, radius), unit);
}

// A drawing in a wrong unit names the one with which it fits, and no other.
TEST_F(DrawingInACase, TheUnitWithWhichADrawingFitsIsNamed) {
  const std::map<std::string, std::pair<double, int>> units{
      {"m", {1, 6}}, {"cm", {1e-2, 5}}, {"mm", {1e-3, 4}}, {"in", {0.0254, 1}}};
  const std::map<std::string, std::string> words{
      {"m", "in metres"}, {"cm", "in centimetres"}, {"mm", "in millimetres"}, {"in", "in inches"}};
  for (const auto& [right, of_right] : units)
    for (const auto& [stated, of_stated] : units) {
      const double u = of_right.first;
      for (const bool by_case : {true, false}) {
        write("holes.dxf", circle_dxf(0.27 / u, 0.02 / u, by_case ? 0 : of_stated.second));
        const std::string remedy = remedies(read("[[shape.file]]\npath = \"holes.dxf\"\ncount = 16\n" +
                                                 (by_case ? fmt::format("unit = \"{}\"\n", stated) : "")));
        for (const auto& [key, word] : words) {
          const bool is_named = key == right && right != stated;
          EXPECT_EQ(remedy.find(word) != std::string::npos, is_named) << remedy;
          EXPECT_EQ(remedy.find(fmt::format("unit = \"{}\"", key)) != std::string::npos, is_named && by_case)
              << remedy;
        }
        EXPECT_EQ(remedy.empty(), right == stated) << remedy;
        EXPECT_EQ(remedy.find("is in mm"), std::string::npos) << remedy;
      }
    }
}

// In the right unit a drawing of the wrong size names the sizes with which it fits.
TEST_F(DrawingInACase, TheSizeWithWhichADrawingFitsIsNamed) {
  const auto result_of = [&](double x, double radius) {
    write("holes.dxf", circle_dxf(x, radius, 4));
    return read("[[shape.file]]\npath = \"holes.dxf\"\ncount = 16\n");
  };
  for (const double x : {80.0, 320.0, 800.0}) {
    const std::string remedy = remedies(result_of(x, 0.05 * x));
    double least = 0, most = 0;
    ASSERT_EQ(std::sscanf(remedy.c_str(), "it fits if it is drawn %lf to %lf times", &least, &most), 2)
        << remedy;
    for (const double factor : {least, most})
      EXPECT_EQ(remedies(result_of(factor * x, factor * 0.05 * x)), "") << factor;
    for (const double factor : {0.98 * least, 1.02 * most})
      EXPECT_NE(remedies(result_of(factor * x, factor * 0.05 * x)), "") << factor;
  }
  const std::string too_wide = remedies(result_of(270, 90));  // at any size
  EXPECT_NE(too_wide, "");
  EXPECT_EQ(too_wide.find("times as large"), std::string::npos) << too_wide;
  // A shape of the case itself has no unit of its own.
  const std::string circle = remedies(read("[[shape.circle]]\ncenter_radius = 270\nradius = 20\n"));
  EXPECT_NE(circle, "");
  EXPECT_EQ(circle.find("it fits if"), std::string::npos) << circle;
}

TEST_F(DrawingInACase, AWheelInMillimetresAroundADrawingIsRecognized) {
  write("holes.dxf", circle_dxf(270, 20, 4));
  const std::string file = "[[shape.file]]\npath = \"holes.dxf\"\ncount = 16\n";
  const auto in_metres = [&](double inner, double outer) {
    return remedies(
        read(fmt::format("[wheel]\ninner_radius = {}\nouter_radius = {}\n", inner, outer) + file));
  };
  EXPECT_NE(in_metres(200, 340).find("if 340 is in mm, write 0.34"), std::string::npos);
  EXPECT_EQ(in_metres(0.2, 0.34), "");
  const std::string twice_the_wheel = in_metres(0.4, 0.68);  // the hole lies in the hub
  EXPECT_NE(twice_the_wheel, "");
  EXPECT_EQ(twice_the_wheel.find("is in mm"), std::string::npos) << twice_the_wheel;
}

TEST_F(DrawingInACase, AWholeWheelThatIsDrawnAsHolesIsRecognized) {
  const std::string hint = "[[shape.annulus]] before it", whole = spoked_wheel(std::vector<double>(16, 0));
  const auto remedies_of = [&](const std::string& drawing, const std::string& keys) {
    write("wheel.svg", drawing);
    return remedies(read(keys + "path = \"wheel.svg\"\n"));
  };
  EXPECT_NE(remedies_of(whole, "[[shape.file]]\n").find(hint), std::string::npos);
  EXPECT_EQ(remedies_of(whole, "[[shape.annulus]]\n[[shape.file]]\nas = \"material\"\n"), "");
  // Holes that end elsewhere than at the tread, and material.
  for (const double radius : {100.0, 50.0}) {
    const std::string hole = fmt::format("<circle cx='270' r='{}'/>", radius);
    const std::string remedy = remedies_of(svg(hole), "[[shape.file]]\ncount = 16\n");
    EXPECT_EQ(remedy.find(hint), std::string::npos) << remedy;
  }
}

TEST_F(DrawingInACase, NonFilesAreUnreadable) {
  for (const char* path : {"missing.svg", ".svg", "/dev/zero", "../.."}) {
    const CaseResult result = read(fmt::format("[[shape.file]]\npath = \"{}\"\n", path));
    ASSERT_EQ(result.problems.size(), 1u) << path;
    EXPECT_EQ(result.problems[0].line, 2) << result.problems[0].text();
  }
}

}  // namespace
}  // namespace wheelwright::testing
