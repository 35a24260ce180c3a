// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/export/paraview_view.hpp"

#include <fmt/format.h>

#include <string_view>

namespace dem {
namespace {

constexpr const char* k_head =
    R"py(# Opens the series of an export of DEM4GRM in ParaView: the specimen, its force chains, and all else in the pipeline.
#
#     paraview --script=view.py
#     pvpython view.py picture.png       draws the last state without a window
#
# Made for the Python interface of ParaView 5.11; the steps by hand stand in docs/how-to/paraview.md.
)py";

// In two parts: compilers need not take longer literals.
constexpr const char* k_steps = R"py(
import os
import sys

from paraview.simple import *

BLACK, WHITE, GREY = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (0.55, 0.55, 0.55)
SAND, RUBBER = (0.73, 0.64, 0.50), (0.19, 0.28, 0.37)
KINDS = {  # of contacts: colours that colour-blind eyes tell apart
    "0": ("gravel-gravel", (0.76, 0.25, 0.05)),
    "1": ("gravel-rubber", (0.49, 0.23, 0.93)),
    "2": ("rubber-rubber", (0.05, 0.45, 0.56)),
    "3": ("wall", GREY),
}


def here():
    """Folder of the series: that of this script; where nobody says it, the working folder or where it was made."""
    if "__file__" in globals():
        return os.path.dirname(os.path.abspath(__file__))
    return os.getcwd() if os.path.exists("balls.pvd") else MADE_IN


def open_all():
    """Readers of the series by their names."""
    return {name: PVDReader(registrationName=name, FileName=os.path.join(here(), name + ".pvd")) for name in SERIES}


def colour_by_kind(display, view, place, names):
    """Colours by the array `kind` of points or cells; names: number as text to (label, colour)."""
    ColorBy(display, (place, "kind"), separate=True)
    table = GetColorTransferFunction("kind", display, separate=True)
    table.InterpretValuesAsCategories = 1
    table.Annotations = [word for number, (label, _) in names.items() for word in (number, label)]
    table.IndexedColors = [part for _, colour in names.values() for part in colour]
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle, bar.LabelColor, bar.LabelFontSize = "", "", BLACK, 10
    display.SetScalarBarVisibility(view, True)


def show_balls(balls, view):
    """Balls as spheres that the graphics card draws, so that 200,000 of them still turn smoothly."""
    display = Show(balls, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Sphere"
    display.ScaleByArray = 1
    display.SetScaleArray = ["POINTS", "radius_mm"]
    display.UseScaleFunction = 0
    display.GaussianRadius = 1.0
    colour_by_kind(display, view, "POINTS", {"0": ("gravel", SAND), "1": ("rubber", RUBBER)})


def show_chains(contacts, view):
    """Strong contacts as tubes: radius by normal force, up to 1 mm for the largest one of the last state."""
    strong = Threshold(registrationName="strong contacts", Input=contacts, Scalars=["CELLS", "strong"])
    strong.LowerThreshold, strong.UpperThreshold = 1, 1
    lines = ExtractSurface(registrationName="strong lines", Input=strong)
    radius = Calculator(registrationName="tube radius", Input=lines, ResultArrayName="radius_mm")
    radius.Function = f"normal_force_N*{1.0 / contacts.PointData['normal_force_N'].GetRange()[1]:.4g}"
    tubes = Tube(registrationName="force chains", Input=radius, Scalars=["POINTS", "radius_mm"])
    tubes.VaryRadius, tubes.NumberofSides = "By Absolute Scalar", 12
    colour_by_kind(Show(tubes, view), view, "CELLS", KINDS)


)py";

constexpr const char* k_main = R"py(def show_bonds(bonds, view):
    """Bonds as tubes, coloured by strain, compression positive."""
    tubes = Tube(registrationName="bond tubes", Input=bonds, Radius=0.1, NumberofSides=12)
    display = Show(tubes, view)
    ColorBy(display, ("CELLS", "strain"))
    bar = GetScalarBar(GetColorTransferFunction("strain"), view)
    bar.Title, bar.ComponentTitle, bar.TitleColor, bar.LabelColor = "strain", "", BLACK, BLACK
    bar.TitleFontSize = bar.LabelFontSize = 10
    display.SetScalarBarVisibility(view, True)


def show_walls(walls, view):
    """As outlines, so that they hide nothing."""
    display = Show(walls, view)
    display.SetRepresentationType("Wireframe")
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = GREY


def new_view(title):
    view = CreateView("RenderView")
    view.UseColorPaletteForBackground = 0
    view.Background, view.OrientationAxesLabelColor = WHITE, BLACK
    text = Show(Text(registrationName=title, Text=title), view)
    text.Color, text.FontSize, text.WindowLocation = BLACK, 12, "Upper Center"
    return view


def show_displacement(reader, view):
    text = Show(AnnotateTimeFilter(registrationName="displacement", Input=reader, Format="{time:.2f} mm"), view)
    text.Color, text.FontSize, text.WindowLocation = BLACK, 12, "Upper Left Corner"


def look_from_the_side(view):
    """Shear direction to the right, up is up."""
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = (0, -1, 0), (0, 0, 0), (0, 0, 1)
    view.CameraParallelProjection = 1
    ResetCamera(view)


def main():
    sources = open_all()
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    contacts = sources["contacts"]
    UpdatePipeline(scene.AnimationTime, contacts)
    kinds = contacts.CellData["kind"]
    has_chains = kinds is not None and kinds.GetRange()[0] < 3  # one grain between plates has none
    left, right = new_view("specimen"), new_view("strong contacts" if has_chains else "bonds")
    layout = CreateLayout("specimen")
    layout.SplitHorizontal(0, 0.5)
    AssignViewToLayout(left, layout, 1)
    AssignViewToLayout(right, layout, 2)
    show_balls(sources["balls"], left)
    if has_chains:
        show_chains(contacts, right)
    elif "bonds" in sources:
        show_bonds(sources["bonds"], right)
    show_displacement(sources["balls"], left)
    for view in (left, right):
        show_walls(sources["walls"], view)
        look_from_the_side(view)
    AddCameraLink(left, right, "both views")
    RenderAllViews()
    if len(sys.argv) > 1 and sys.argv[-1].endswith(".png"):
        SaveScreenshot(sys.argv[-1], layout, ImageResolution=(1600, 800))


main()
)py";

/// The text as Python writes it.
std::string python_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const bool is_control = static_cast<unsigned char>(c) < 0x20U;
    if (c == '"' || c == '\\') out += '\\';
    out += is_control ? fmt::format("\\x{:02x}", static_cast<unsigned char>(c)) : std::string(1, c);
  }
  return out + "\"";
}

}  // namespace

std::string view_script(std::span<const std::string> series, const std::filesystem::path& folder) {
  std::string names;
  for (const std::string& name : series) names += fmt::format("{}{}", names.empty() ? "" : ", ", python_text(name));
  return fmt::format("{}\nSERIES = [{}]\nMADE_IN = {}\n{}{}", k_head, names, python_text(folder.string()), k_steps,
                     k_main);
}

}  // namespace dem
