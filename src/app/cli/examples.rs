//! Examples in the help of the commands of one saw.

pub const CHECK: &str = "\
Examples:
  sawflutter check my-saw.json --rpm 2400
  sawflutter check my-saw.json --min-flutter 2000 --min-critical 1500
  sawflutter check --rpm 1250 --json | jq .passed
  sawflutter check my-saw.json --max-amplitude 0.5mm
  sawflutter check my-saw.json --out checked # with a picture

Exit code: 0 every limit is kept, 1 one is not, 2 the input was refused.";

pub const CUT: &str = "\
Examples:
  sawflutter cut                               # the built-in saw, two speeds
  sawflutter cut my-saw.json --rpm 2400        # your own saw at another speed
  sawflutter cut my-saw.json --power 20kW --depth 100mm # a scene without a cut
  sawflutter cut --stretching                  # past five thicknesses
  sawflutter cut --json | jq '.runs[].verdict.answer' # for scripts

The forces are the scene's `cut`; `sawflutter schema` says what it may contain.";

pub const DEFLECT: &str = "\
Examples:
  sawflutter deflect                            # the built-in saw
  sawflutter deflect my-saw.json --force 10     # your own saw, pressed more
  sawflutter deflect --force 0                  # which way does it buckle?
  sawflutter deflect --to 2000 --accuracy draft # faster
  sawflutter deflect --json | jq '.up.jumps[]'  # for scripts

The blade stretches where it bends by more than a part of its thickness, and
leans to one side where the flat blade is unstable. The deflection is read at
the scene's `probe`.";

pub const FIT: &str = "\
Examples:
  sawflutter fit --to 1250                # the built-in saw to its own table
  sawflutter fit my-saw.json measured.csv # radius and stiffness of every guide
  sawflutter fit my-saw.json measured.csv \\
    --free \"guides[0].radius_m=0.15..0.3\" \\
    --free blade.material.density_kg_per_m3

measured.csv: a speed in rpm, then frequencies in Hz, ascending; blank where a
mode was not seen. They are compared with the lowest computed ones. A first line
like rpm,f1,f2 names the columns, in any order; semicolons with decimal commas
and tabs are read too. A tap test is a row at speed 0: a pair of equal
frequencies counts once, or twice; rpm,n0,n1 names columns by nodal diameters.
The calibrated scene is fitted-scene.json.";

pub const GAP: &str = "\
Examples:
  sawflutter gap my-saw.json                       # guides with a gap
  sawflutter gap my-saw.json --gap 0.05mm          # guides without one
  sawflutter gap my-saw.json --force 10 --rpm 2400 # another force and speed
  sawflutter gap my-saw.json --max-deviation 0.1mm # with a tolerance
  sawflutter gap my-saw.json --oscillating-force 2 # with an oscillation
  sawflutter gap my-saw.json --friction 0.2        # with the heat of the pads
  sawflutter gap my-saw.json --json | jq .half_way_amplitude_m

At least one guide needs `contact` one_sided and a `gap_m`, or give --gap. The
deflection is that of the rim at the cut under the scene's `side_force`, by
default the lateral force of its cut, or 1 N there.";

pub const PLACE: &str = "\
Examples:
  sawflutter place my-saw.json   # radius, angle, stiffness of guides[0]
  sawflutter place my-saw.json --free \"guides[0].radius_m=0.2..0.3\" \\
    --free \"guides[0].angle_deg=-90..-20\" --min-critical 1500
  sawflutter place --goal window # widest window around operating_rpm
  sawflutter place --radius-tolerance 0.5mm --angle-tolerance 0.2
The best saw is placed-scene.json; try it with `check` and `cut`. Without a saw
that keeps the limits none is written.

Every saw counts as the worst of those whose numbers are off by the tolerances
of production, by default 2 mm of a radius, 1 degree of an angle, 10 % of a
stiffness, damping or gap, 1 % of other numbers.

Exit code: 0 done, 1 no tried saw keeps the limit within all its tolerances,
2 the input was refused or the run failed.";

pub const REPORT: &str = "\
Examples:
  sawflutter report my-saw.json --out my-saw   # then open my-saw/report.html
  sawflutter report my-saw.json --customer Miller --date 2027-01-15
  sawflutter report my-saw.json --accuracy draft # faster
  sawflutter report my-saw.json --json | jq .speeds

report.html is one page to read, send and print as PDF: the answer idling and in
the cut, the deviation of the board over speed, margins and what usual
tolerances of production take of them, the changes that help most, figures,
inputs and checks. Tolerances are 2 mm of a radius, 1° of an angle, 10 % of a
stiffness and 1 % of other numbers.";

pub const RESPONSE: &str = "\
Examples:
  sawflutter response my-saw.json              # what the scene has of causes
  sawflutter response my-saw.json --force 5N --set response.flatness_m=0.05mm
                             # a side force, a warped blade
  sawflutter response my-saw.json --rpm 1200 --to-frequency 300
                             # from the force to the probe, over the frequency
  sawflutter response my-saw.json --json | jq '.lines[].resonances'

Causes are `side_force`, constant or oscillating, and runout_m, flatness_m and
imbalance_kg_m2 of the block `response`. Without any, the force is the lateral
one of the cut, or 1 N.";

pub const RUNUP: &str = "\
Examples:
  sawflutter runup                         # the built-in saw, 0 to 4000 rpm
  sawflutter runup my-saw.json --out runup # your own saw
  sawflutter runup my-saw.json --to 4000 --seconds 60 --force 5N
  sawflutter runup --stretching            # past five thicknesses
  sawflutter runup --json | jq '.bands[]'  # for scripts

Speeds and duration are the scene's `runup`, the force its `side_force` or 1 N,\nthe probe its `probe`.";

pub const WASHBOARD: &str = "\
Examples:
  sawflutter washboard my-saw.json                      # is the board smooth?
  sawflutter washboard my-saw.json --rpm 2400           # at another speed
  sawflutter washboard my-saw.json --stiffness 20kN/m   # a scene without
  sawflutter washboard my-saw.json --json | jq .verdict # for scripts

The cutting stiffness is the scene's `cut.washboarding`; `sawflutter schema`
says what that may contain.";

pub const SIZE: &str = "\
Examples:
  sawflutter size my-saw.json --vary blade.thickness_m # how thick?
  sawflutter size my-saw.json --vary blade.thickness_m=1.8mm..3.2mm --rpm 2400
  sawflutter size my-saw.json --vary operating_rpm=500..4000 # how fast?
  sawflutter size my-saw.json --vary guides[0].radius_m # where?
  sawflutter size my-saw.json --vary guides[*].gap_m --max-deviation 0.2mm
                                       # how much may the guides wear?

The limits are those of `check`: the scene's `limits`, or options. The saw with
the value of the answer is sized-scene.json.

Exit code: 0 some value keeps all limits, 1 none does, 2 the input was refused.";
