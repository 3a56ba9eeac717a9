"""Runs of the program whose files are compared: each has a name, arguments, and changes of its scene.

In the arguments, `saw` stands for the scene with the changes, and other names of scenes for the files in `scenes/`.
Changes have a path of the scene and a value, which may be an object; None removes the key.
"""

SHORT = {"sweep.to_rpm": 1700, "operating_rpm": 1000, "measured": None}
ONE_SIDED = {**SHORT, "sweep.to_rpm": 1400, "guides.0.contact": "one_sided", "guides.0.gap_m": 4e-5}
CAUSES = {"response": {"flatness_m": 5e-5, "runout_m": 0}, "side_force.oscillating_n": 1, "side_force.order": 42}
BRIEF = {"runup.to_rpm": 2600, "runup.duration_s": 6}
PADS = ["--force", "2", "--max-deviation", "0.3mm", "--oscillating-force", "0.5", "--friction", "0.2"]
QUICK_PLACE = ["--free", "guides[0].radius_m=0.195..0.205", "--samples", "3", "--refine", "4"]
THICKNESS = ["--x", "blade.thickness_m=2.6mm..3mm", "--points", "3"]
SIZED = ["--points", "5", "--rpm", "1300"]
STUDY = {
    "name": "two numbers",
    "parameters": [
        {"path": "blade.thickness_m", "distribution": {"kind": "tolerance", "plus_minus": 5e-5}},
        {"path": "guides[0].radius_m", "distribution": {"kind": "normal", "standard_deviation": 0.002}},
    ],
    "saws": 20,
    "seed": 1,
    "to_rpm": 2500,
    "limits": {"operating_rpm": 1285, "margin": 0.85, "min_flutter_rpm": 2220},
}

# Scenes of which `analyze` computes the chart, beside the cases.
CHARTED = ["scenes/*.json", "scenes/gallery/*.json"]

# name: (scene, changes, arguments).
CASES = {
    # The chart, with everything that is computed on request.
    "analyze-paper": ("paper", {}, ["analyze", "saw", "--sensitivity", "--amplitude", "--rpm", "1800"]),
    "analyze-shapes": ("paper", {"sweep.to_rpm": 2000}, ["analyze", "saw", "--shapes", "--vtk"]),
    "analyze-free": ("free-blade", {"sweep.to_rpm": 1500}, ["analyze", "saw"]),
    "analyze-damped": ("gallery/damped-pad", {"sweep.to_rpm": 2600}, ["analyze", "saw", "--rpm", "1800"]),
    "analyze-heated": ("gallery/heated-rim", {}, ["analyze", "saw"]),
    "analyze-in-cut": ("gallery/in-cut-wood", {}, ["analyze", "saw"]),
    "analyze-excited": ("gallery/excitation-lines", {}, ["analyze", "saw"]),
    "analyze-json": ("free-blade", {"sweep.to_rpm": 1500}, ["analyze", "saw", "--json"]),
    # The commands with a report.
    "check-passed": ("paper", {}, ["check", "saw", "--rpm", "1250", "--max-amplitude", "0.5mm"]),
    "check-failed": ("paper", {}, ["check", "saw", "--rpm", "1800", "--min-flutter", "2800"]),
    "check-free": ("paper", {"guides": []}, ["check", "saw", "--rpm", "600"]),
    "compare-two": ("paper", {}, ["compare", "saw", "scenes/two-pads.json"]),
    "compare-variants": ("free-blade", {"sweep.to_rpm": 1500}, ["compare", "saw", "--variant", "blade.thickness_m=2.6mm"]),
    "cut-paper": ("paper", {"cut.board_length_m": 0.5}, ["cut", "saw"]),
    "cut-spline": ("paper-spline", {"cut.board_length_m": 0.2}, ["cut", "saw"]),
    "cut-stretching": ("paper", {"cut.board_length_m": 0.2, "cut.stretching": True}, ["cut", "saw", "--rpm", "2800"]),
    "cut-wood": ("gallery/in-cut-wood", {"cut.board_length_m": 0.5}, ["cut", "saw", "--rpm", "2000"]),
    "deflect-jumps": ("paper", {}, ["deflect", "saw", "--force", "2", "--to", "1700"]),
    "deflect-lifts": ("paper", ONE_SIDED, ["deflect", "saw", "--force", "3", "--to", "600"]),
    "fit-paper": ("paper", {}, ["fit", "saw", "--to", "1250", "--starts", "2"]),
    "fit-one-number": ("paper", {}, ["fit", "saw", "--to", "500", "--starts", "1", "--free", "guides[0].radius_m"]),
    "gap-all": ("paper", ONE_SIDED, ["gap", "saw", *PADS]),
    "gap-film": ("gallery/water-film", {"guides.0.contact": "one_sided"}, ["gap", "saw"]),
    "map-speed": ("paper", SHORT, ["map", "saw", *THICKNESS]),
    "map-two-numbers": ("paper", SHORT, ["map", "saw", *THICKNESS, "--y", "guides[0].radius_m=0.15..0.25"]),
    "place-fragile": ("paper", {}, ["place", "saw", *QUICK_PLACE, "--map", "2"]),
    "place-limit": ("paper", {}, ["place", "saw", *QUICK_PLACE, "--map", "0", "--min-critical", "9000"]),
    "place-window": ("paper", {}, ["place", "saw", *QUICK_PLACE, "--map", "0", "--goal", "window"]),
    "report-paper": ("paper", SHORT, ["report", "saw", "--customer", "A. Miller", "--date", "2027-01-15"]),
    "response-causes": ("paper", {**SHORT, **CAUSES}, ["response", "saw"]),
    "response-frequencies": ("gallery/damped-pad", {}, ["response", "saw", "--rpm", "1200", "--to-frequency", "100"]),
    "response-resonance": ("paper", {"side_force.force_n": 2}, ["response", "saw"]),
    "runup-paper": ("paper", BRIEF, ["runup", "saw"]),
    "runup-ends": ("paper", {**BRIEF, "side_force.force_n": 500}, ["runup", "saw"]),
    "runup-stretching": ("paper", BRIEF, ["runup", "saw", "--stretching"]),
    "washboard-grows": ("gallery/washboarding", {}, ["washboard", "saw"]),
    "washboard-smooth": ("gallery/washboarding", {"cut.washboarding.stiffness_n_per_m": 100}, ["washboard", "saw"]),
    "size-thickness": ("paper", {}, ["size", "saw", *SIZED, "--vary", "blade.thickness_m=2mm..3.2mm"]),
    "size-none": ("paper", {}, ["size", "saw", *SIZED, "--vary", "guides[0].radius_m=0.3..0.34"]),
    # A study, its parts, and their sum.
    "study-whole": ("paper", {}, ["study", "saw", "study"]),
    "study-part": ("paper", {}, ["study", "saw", "study", "--shard", "1/2"]),
    # Other files and texts.
    "several": ("paper", {}, ["analyze", "scenes/free-blade.json", "scenes/gallery/weak-pad.json"]),
    "matrices": ("gallery/damped-pad", {}, ["export", "saw", "--matrices", "--basis", "4,4"]),
    "keys": (None, {}, ["keys"]),
    "keys-of-a-study": (None, {}, ["keys", "--study"]),
    "schema": (None, {}, ["schema"]),
    "schema-of-a-study": (None, {}, ["schema", "--study"]),
    "version": (None, {}, ["--version"]),
    # Refusals.
    "refused-value": ("paper", {"blade.thickness_m": -1}, ["analyze", "saw"]),
    "refused-key": ("paper", {"blade.thicknes_m": 0.003}, ["analyze", "saw"]),
    "refused-option": ("paper", {}, ["gap", "saw", "--friction", "-1"]),
    "refused-free-blade": ("free-blade", {}, ["deflect", "saw"]),
    "refused-without-cut": ("paper", {"cut": None}, ["cut", "saw"]),
}
HELP = (
    "analyze report cut runup response deflect gap washboard check explore fit size place study map compare tradeoff export keys schema"
)
CASES |= {f"help-{name}": (None, {}, [name, "--help"]) for name in HELP.split()}
CASES["help"] = (None, {}, ["--help"])
