//! The table of the numbers of a scene.
//!
//! Each number is declared once, here: its path, name and unit, the range that is allowed, the range of saws in use, its kind, and
//! a typical value. Checks, schema, help, forms, warnings, searches and documentation read this table.

use super::quantity::{Kind, Quantity, q};
use super::span::Span;

/// Diameter or length: from that of a grain to twice the largest stone saw, which has 5 m.
const LENGTH: Span = Span::closed(1e-5, 10.0);
const LENGTH_OR_NONE: Span = Span::closed(0.0, 10.0);
/// Distance from the axis on a blade of the largest diameter.
const RADIUS: Span = Span::closed(1e-5, 5.0);
const RADIUS_OR_NONE: Span = Span::closed(0.0, 5.0);
/// Thickness: from that of an atom, which a membrane without stiffness in bending approximates, to that of a millstone.
const THICKNESS: Span = Span::closed(1e-10, 1.0);
/// Stiffness of a contact. A steel block of 50 mm by 50 mm by 50 mm has EA/h = 1e10 N/m; a body that supports it has less.
const STIFFNESS: Span = Span::closed(0.0, 1e10);
/// Moment per angle and length of a clamp. The flexural rigidity of steel over its thickness is Eh²/12(1 − ν²): 2e8 N for 0.1 m.
const CLAMP: Span = Span::closed(0.0, 1e9);
/// Damping of a contact. At 1000 rad/s the largest one holds the blade as firmly as the largest stiffness.
const DAMPING: Span = Span::closed(0.0, 1e7);
/// Ten turns either way.
const ANGLE: Span = Span::closed(-3600.0, 3600.0);
const ARC: Span = Span::closed(1e-3, 360.0);
/// Stiffness relative to that of a plain blade.
const FACTOR: Span = Span::closed(0.1, 2.0);
const SHARE: Span = Span::closed(0.0, 1.0);
/// Rotation speed. Any blade above a diameter of a millimetre bursts long before its end.
const SPEED: Span = Span::closed(0.0, 1e8);
/// Rotation speed of a cut, in which the power determines a force.
const CUT_SPEED: Span = Span::closed(1e-3, 1e8);
const FEED: Span = Span::closed(1e-6, 1e3);
/// Many times the force that shears a tooth off.
const FORCE: Span = Span::closed(-1e9, 1e9);
/// Power of the cut. The largest motors have 1e8 W.
const POWER: Span = Span::closed(0.0, 1e8);
/// Temperature rise. No blade survives a larger one.
const RISE: Span = Span::closed(-2e3, 2e3);
/// Steel breaks at 3e9 Pa.
const STRESS: Span = Span::closed(-1e11, 1e11);

/// Coefficient of a transfer function, in a unit of its own.
const COEFFICIENT: Span = Span::closed(-1e60, 1e60);

/// All numbers that a scene may contain, in the order of the schema. The ranges of saws in use include all machines that are
/// built: diameters from 50 mm (slitting saws) to 4 m (stone saws), materials from aluminium to tungsten carbide, guides from
/// felt to steel.
#[rustfmt::skip]
pub static QUANTITIES: [Quantity; 125] = [
    q("blade.outer_diameter_m", "outer diameter", "m", LENGTH, 0.04, 5.0),
    q("blade.inner_diameter_m", "bore diameter", "m", LENGTH, 0.003, 2.0),
    q("blade.thickness_m", "thickness of the blade", "m", THICKNESS, 1e-4, 0.04),
    q("blade.profile[].radius_m", "radius", "m", RADIUS, 1e-3, 2.5).of_kind(Kind::Radius),
    q("blade.profile[].thickness_m", "thickness", "m", THICKNESS, 1e-4, 0.04),
    // Zero is a disc without teeth. No blade has as many teeth as the upper end.
    q("blade.teeth", "number of teeth", "", Span::closed(0.0, 1e4), 1.0, 1000.0).of_kind(Kind::Count)
        .typically(0.03, "m of pitch", 0.01, 0.06, "assumption of this program; the paper's saw has 0.053 m"),
    // No tooth is heavier.
    q("blade.rim.mass_per_tooth_kg", "mass of a tooth", "kg", Span::closed(0.0, 1e3), 1e-6, 10.0),
    q("blade.rim.radius_m", "radius of the mass of teeth", "m", RADIUS, 0.02, 2.5).of_kind(Kind::Radius),
    // Segments of the largest stone saws; the mesh between two slots grows with their distance.
    q("blade.slots.count", "number of slots", "", Span::closed(1.0, 500.0), 2.0, 100.0).of_kind(Kind::Count),
    q("blade.slots.depth_m", "depth of the slots", "m", LENGTH, 1e-3, 0.5),
    q("blade.slots.width_m", "width of the slots", "m", Span::closed(0.0, 1e-3), 1e-5, 1e-3),
    q("blade.slots.inclination_deg", "inclination of the slots", "°", Span::closed(-20.0, 20.0), -20.0, 20.0),
    q("blade.slots.hole_diameter_m", "diameter of the slots' holes", "m", LENGTH_OR_NONE, 1e-3, 0.05),
    // The largest basis has waves of up to 300 nodal diameters.
    q("blade.wave_factors[].nodal_diameters", "number of nodal diameters", "", Span::closed(0.0, 300.0), 0.0, 60.0).of_kind(Kind::Count),
    // Slots leave more than 0.3, and nothing that is fixed to a blade doubles its stiffness.
    q("blade.wave_factors[].bending", "factor of the bending stiffness", "", FACTOR, 0.3, 1.1),
    q("blade.wave_factors[].rotation", "factor of the stiffening by rotation", "", FACTOR, 0.3, 1.2),
    q("blade.wave_factors[].split", "split of the pair of waves", "", SHARE, 1e-4, 0.5),
    // From rubber to ten times diamond.
    q("blade.material.youngs_modulus_pa", "Young's modulus", "Pa", Span::closed(1e7, 1e13), 4e10, 7.5e11),
    // The limits of an isotropic material.
    q("blade.material.poisson_ratio", "Poisson's ratio", "", Span::open(-1.0, 0.5), 0.15, 0.45),
    // From aerogel to forty times osmium, the densest metal.
    q("blade.material.density_kg_per_m3", "density", "kg/m³", Span::closed(1.0, 1e6), 2e3, 2e4),
    q("mount.diameter_m", "collar diameter", "m", LENGTH, 0.01, 3.0),
    // Below, thin blades turn freely at the collar; above, thick ones are clamped rigidly.
    q("mount.clamp_stiffness_n_m_per_rad_per_m", "bending stiffness of the clamp", "N·m/(rad·m)", CLAMP, 100.0, 1e7).of_kind(Kind::Stiffness),
    q("guides[].radius_m", "radius of the guide", "m", RADIUS_OR_NONE, 0.005, 2.5).of_kind(Kind::GuideRadius),
    q("guides[].angle_deg", "angle of the guide", "°", ANGLE, -360.0, 360.0).of_kind(Kind::Angle),
    q("guides[].radial_length_m", "radial length of the guide", "m", LENGTH_OR_NONE, 1e-4, 1.0),
    q("guides[].tangential_length_m", "tangential length of the guide", "m", LENGTH_OR_NONE, 1e-4, 1.0),
    q("guides[].stiffness_n_per_m", "stiffness of the guide", "N/m", STIFFNESS, 2.5e4, 1e10).of_kind(Kind::Stiffness)
        .typically(1e7, "", 1e6, 2e8, "2e7 was calibrated on the paper's Table 5 for a pad of 0.15 m by 0.15 m with 0.05 mm clearance; upper end computed from a pressurized film"),
    q("guides[].damping_n_s_per_m", "damping of the guide", "N·s/m", DAMPING, 1e-2, 1e6).of_kind(Kind::Damping),
    // A hundredth of an atom is no gap; no blade closes a larger one.
    q("guides[].gap_m", "gap of the guide", "m", Span::closed(1e-12, 1.0), 1e-6, 5e-3).of_kind(Kind::Gap),
    q("guides[].film_stiffness_n_per_m", "stiffness within the gap of the guide", "N/m", STIFFNESS, 10.0, 1e10),
    // A softer arm holds nothing; the upper end is that of contacts.
    q("guides[].arm.stiffness_n_per_m", "stiffness of the guide's arm", "N/m", Span::closed(1e-6, 1e10), 2.5e4, 1e10).of_kind(Kind::Stiffness)
        .typically(2.5e6, "", 5e5, 7e7, "computed from 3EI/l³ for steel arms of 40 mm by 20 mm, bent over the 40 mm, 0.5 to 0.1 m long; 0.3 m is usual"),
    // A head of ten tonnes is heavier than the machine.
    q("guides[].arm.mass_kg", "mass of the guide's head", "kg", Span::closed(0.0, 1e4), 0.01, 100.0)
        .typically(1.5, "", 0.3, 5.0, "assumption of this program: a steel block of 50 mm by 50 mm by 50 mm and 33/140 of the arm's mass"),
    q("guides[].arm.damping_n_s_per_m", "damping of the guide's arm", "N·s/m", DAMPING, 1e-2, 1e6).of_kind(Kind::Damping),
    q("guides[].arm.loss_factor", "loss factor of the guide's arm", "", SHARE, 1e-4, 0.3),
    q("guides[].film.lag_s", "lag of the guide's film", "s", Span::closed(1e-7, 10.0), 1e-7, 0.1)
        .typically(1e-4, "", 1e-5, 1e-2, "computed from 12ηb²/(π²h²p) of films 0.05 mm thick under pads 20 mm wide: 4e-5 s of air, 4e-5 to 2e-3 s of water with bubbles, whose bulk modulus is 5 to 0.1 MPa (Blech, J. Lubr. Technol. 105, 1983)"),
    q("guides[].controller.numerator[]", "coefficient of the numerator", "", COEFFICIENT, -1e60, 1e60),
    q("guides[].controller.denominator[]", "coefficient of the denominator", "", COEFFICIENT, -1e60, 1e60),
    // No pad of a saw has a larger offset.
    q("guides[].offset_m", "offset of the guide", "m", Span::closed(-0.1, 0.1), -5e-3, 5e-3),
    q("friction.coefficient", "coefficient of friction", "", Span::closed(0.0, 2.0), 0.01, 1.0)
        .typically(0.2, "", 0.1, 0.4, "assumption of this program, for dry steel on a pad"),
    q("friction.heat_share", "share of the heat that enters the blade", "", SHARE, 0.01, 1.0)
        .typically(1.0, "", 0.5, 1.0, "assumption of this program, on the safe side"),
    q("friction.convection_w_per_m2_k", "heat transfer coefficient", "W/(m²·K)", Span::closed(1.0, 1e5), 5.0, 2e4)
        .typically(60.0, "", 30.0, 150.0, "assumption of this program, for air along a fast blade; water has some 1000"),
    q("friction.conductivity_w_per_m_k", "thermal conductivity", "W/(m·K)", Span::closed(0.1, 1e3), 5.0, 450.0)
        .typically(45.0, "", 15.0, 60.0, "steel; property tables of materials"),
    // A material that relaxes more slowly flows.
    q("damping.material_retardation_time_s", "retardation time of the material", "s", Span::closed(0.0, 1.0), 1e-10, 1e-2)
        .typically(1e-6, "", 1e-7, 1e-5, "assumption of this program; computed from damping ratios of 3e-5 to 3e-3 at 100 Hz"),
    q("damping.loss_factor", "loss factor of the blade", "", SHARE, 1e-6, 0.3),
    // The largest basis has waves of up to 300 nodal diameters.
    q("damping.mode_ratios[].diameters", "number of nodal diameters", "", Span::closed(0.0, 300.0), 0.0, 60.0).of_kind(Kind::Count),
    // Half of critical damping.
    q("damping.mode_ratios[].damping_ratio", "damping ratio", "", Span::closed(0.0, 0.5), 1e-6, 0.15)
        .typically(1e-3, "", 3e-4, 1e-2, "assumption of this program; measure it by the decay of a struck blade"),
    // Many times that of water.
    q("damping.air_n_s_per_m3", "air damping", "N·s/m³", Span::closed(0.0, 1e8), 1e-3, 1e5),
    q("damping.air_rotation_share", "speed of the air over that of the blade", "", SHARE, 0.0, 1.0),
    // Polymers have 2e-4.
    q("membrane.temperature.expansion_per_k", "thermal expansion", "1/K", Span::closed(0.0, 1e-2), 3e-6, 3e-5)
        .typically(1.2e-5, "", 1.0e-5, 1.3e-5, "carbon steel; property tables of materials"),
    q("membrane.temperature.rim_rise_k", "temperature rise of the rim", "K", RISE, -200.0, 600.0),
    q("membrane.temperature.from_radius_m", "radius where the rise begins", "m", RADIUS_OR_NONE, 1e-3, 2.5),
    // A steeper rise is nearly a step, which a table describes as well.
    q("membrane.temperature.exponent", "exponent of the rise", "", Span::closed(0.0, 20.0), 0.1, 20.0),
    q("membrane.temperature.table[].radius_m", "radius", "m", RADIUS, 1e-3, 2.5).of_kind(Kind::Radius),
    q("membrane.temperature.table[].rise_k", "temperature rise", "K", RISE, -200.0, 600.0),
    q("membrane.roll_tension[].radius_m", "radius of the rolled band", "m", RADIUS, 1e-3, 2.5).of_kind(Kind::Radius),
    q("membrane.roll_tension[].width_m", "width of the rolled band", "m", LENGTH, 1e-4, 1.0),
    // Rolling produces 1e-4 to 1e-3.
    q("membrane.roll_tension[].eigenstrain", "rolling strain", "", Span::closed(-0.05, 0.05), -0.02, 0.02)
        .typically(1e-4, "", 1e-4, 5e-3, "computed from grooves of 1 to 10 µm by d/h; the small end suits wide bands"),
    // No blade has a deeper groove.
    q("membrane.roll_tension[].groove_depth_m", "depth of the rolled groove", "m", Span::closed(0.0, 0.1), 1e-7, 5e-4),
    q("membrane.residual_stress[].radius_m", "radius", "m", RADIUS, 1e-3, 2.5).of_kind(Kind::Radius),
    q("membrane.residual_stress[].hoop_pa", "hoop stress", "Pa", STRESS, -3e9, 3e9),
    q("membrane.residual_stress[].radial_pa", "radial stress", "Pa", STRESS, -3e9, 3e9),
    q("membrane.straight_edge.length_m", "length of the straight edge", "m", LENGTH, 0.02, 5.0),
    q("membrane.straight_edge.support_radius_m", "radius of the supports", "m", RADIUS, 0.01, 2.5).of_kind(Kind::Radius),
    // No straight edge shows a larger gap.
    q("membrane.straight_edge.measured_gap_m", "light gap", "m", Span::closed(-1.0, 1.0), -0.02, 0.02),
    // The teeth are simulated individually; no spline has more.
    q("spline.teeth", "number of spline teeth", "", Span::closed(1.0, 200.0), 1.0, 200.0).of_kind(Kind::Count),
    // A flank with a larger angle acts as a radial stop and does not drive.
    q("spline.pressure_angle_deg", "pressure angle", "°", Span::closed(0.0, 60.0), 5.0, 60.0),
    // Hertzian contact of a sphere of 100 m on diamond has 1e13 N/m^(3/2).
    q("spline.contact_stiffness_n_per_m_3_2", "contact stiffness", "N/m^(3/2)", Span::closed(1e-12, 1e15), 1e3, 1e14),
    q("spline.contact_damping_n_s_3_2_per_m_3_2", "contact damping", "N·(s/m)^(3/2)", Span::closed(0.0, 1e18), 1e-3, 1e9),
    q("spline.clearance_m", "clearance of the spline", "m", Span::closed(0.0, 1.0), 1e-7, 0.02),
    q("spline.pitch_radius_m", "pitch radius of the spline", "m", RADIUS, 1e-3, 1.0),
    q("spline.weight_angle_deg", "direction of the weight", "°", ANGLE, -360.0, 360.0).of_kind(Kind::Angle),
    // A saw at rest has no operating speed.
    q("operating_rpm", "operating speed", "rpm", Span::above(0.0, 1e8), 30.0, 6e4)
        .typically(60.0, "m/s at the rim", 40.0, 100.0, "the paper's saw runs at 67 m/s; makers of carbide-tipped blades allow 100"),
    // More lines would hide the branches.
    q("limits.margin", "margin to the first critical speed", "", Span::closed(1e-3, 1.0), 0.5, 1.0),
    q("limits.min_critical_rpm", "lowest allowed first critical speed", "rpm", CUT_SPEED, 10.0, 1e5),
    q("limits.min_flutter_rpm", "lowest allowed flutter speed", "rpm", CUT_SPEED, 10.0, 1e5),
    // The upper end exceeds the speed of sound in steel.
    q("limits.max_rim_m_per_s", "largest allowed speed of the rim", "m/s", Span::closed(1e-3, 1e4), 10.0, 300.0),
    // No blade deflects farther.
    q("limits.max_amplitude_m", "largest allowed amplitude of flutter", "m", Span::closed(1e-9, 1.0), 1e-6, 0.02),
    q("limits.max_deviation_m", "largest allowed deflection at the cut", "m", Span::closed(1e-9, 1.0), 1e-6, 0.02),
    q("excitation.orders", "largest multiple of the speed", "", Span::closed(0.0, 60.0), 0.0, 60.0).of_kind(Kind::Count),
    q("excitation.tooth_passing", "largest multiple of tooth passing", "", Span::closed(0.0, 10.0), 0.0, 10.0).of_kind(Kind::Count),
    q("sweep.from_rpm", "first speed of the sweep", "rpm", SPEED, 0.0, 1e5),
    q("sweep.to_rpm", "last speed of the sweep", "rpm", SPEED, 30.0, 2e5),
    // Faster growth than one of a thousandth of a millisecond is that of no saw.
    q("flutter_threshold_per_s", "growth rate that counts as flutter", "1/s", Span::closed(0.0, 1e6), 1e-6, 1e3)
        .typically(0.25, "", 0.1, 1.0, "assumption of this program; computed as the decay rate of 40 Hz at a damping ratio of 1e-3"),
    // A diagram with errors above a tenth is of no use, and no basis reaches 1e-8.
    q("tolerance", "tolerance", "", Span::closed(1e-7, 0.1), 1e-7, 0.1),
    q("cut.angle_deg", "angle of the cut", "°", ANGLE, -360.0, 360.0).of_kind(Kind::Angle),
    q("cut.depth_m", "depth of cut", "m", LENGTH, 1e-4, 3.0)
        .typically(0.25, "of the outer diameter", 0.05, 0.35, "the paper's saw cuts 0.28 of its diameter"),
    q("cut.teeth_in_cut", "teeth in the cut", "", Span::closed(1.0, 1e4), 1.0, 1000.0).of_kind(Kind::Count),
    q("cut.tangential_n_per_tooth", "tangential force on a tooth", "N", FORCE, -1e5, 1e5),
    q("cut.radial_n_per_tooth", "radial force on a tooth", "N", FORCE, -1e5, 1e5)
        .typically(20.0, "", 0.0, 90.0, "assumption of this program; the paper's Table 3 has 75 and 88 in Douglas fir, at bites of 1.6 mm"),
    q("cut.lateral_n_per_tooth", "lateral force on a tooth", "N", FORCE, -1e5, 1e5)
        .typically(1.0, "", 0.0, 5.0, "assumption of this program; the paper's Table 3 has 3 and 4.5 in Douglas fir"),
    q("cut.power_w", "power of the cut", "W", POWER, 100.0, 2e6)
        .typically(2e5, "W per metre of depth", 5e4, 3e5, "the paper's Table 2: 2.2e5 and 3.0e5 in Douglas fir, at bites of 1.6 mm"),
    q("cut.feed_m_per_s", "feed", "m/s", FEED, 1e-5, 10.0)
        .typically(1.0, "", 0.1, 3.0, "assumption of this program; the paper's saw is fed at 2.0 and 3.0"),
    // From a splinter to ten kilometres.
    q("cut.board_length_m", "length of the board", "m", Span::closed(1e-4, 1e4), 0.01, 50.0)
        .typically(2.0, "", 1.0, 6.0, "assumption of this program; the paper gives none"),
    // The record of a longer time would not fit into memory.
    q("cut.idle_s", "time before and after the cut", "s", Span::closed(0.0, 600.0), 0.0, 600.0)
        .typically(0.5, "", 0.0, 2.0, "assumption of this program, to see the blade before and after the cut"),
    q("cut.chart_rpm", "speed of the cut in the diagram", "rpm", CUT_SPEED, 30.0, 6e4),
    q("cut.wood.stiffness_n_per_m", "stiffness of the wood", "N/m", STIFFNESS, 1.0, 1e9).of_kind(Kind::Stiffness),
    q("cut.wood.damping_n_s_per_m", "damping of the wood", "N·s/m", DAMPING, 1e-3, 1e6).of_kind(Kind::Damping),
    q("cut.wood.depth_m", "depth of the contact with the wood", "m", LENGTH_OR_NONE, 1e-4, 2.0),
    q("cut.wood.arc_deg", "arc of the contact with the wood", "°", ARC, 1.0, 360.0),
    // No wood and no blade is laterally stiffer.
    q("cut.washboarding.stiffness_n_per_m", "lateral cutting stiffness", "N/m", Span::above(0.0, 1e9), 10.0, 1e8).of_kind(Kind::Stiffness)
        .typically(2e4, "", 5e3, 1e5, "no published value known; computed from the cutting force and the bite"),
    q("cut.washboarding.overlap", "overlap with the preceding tooth", "", SHARE, 0.0, 1.0)
        .typically(1.0, "", 0.0, 1.0, "all teeth in one groove, with the largest delayed force"),
    q("cut.washboarding.arc_deg", "arc of the teeth in the cut", "°", ARC, 1.0, 360.0),
    q("cut.washboarding.pitches_deg[]", "pitch of a tooth", "°", Span::above(0.0, 360.0), 0.3, 360.0),
    q("cut.speeds[].rpm", "speed of the cut", "rpm", CUT_SPEED, 30.0, 6e4),
    q("cut.speeds[].tangential_n_per_tooth", "tangential force on a tooth", "N", FORCE, -1e5, 1e5),
    q("cut.speeds[].radial_n_per_tooth", "radial force on a tooth", "N", FORCE, -1e5, 1e5),
    q("cut.speeds[].lateral_n_per_tooth", "lateral force on a tooth", "N", FORCE, -1e5, 1e5),
    q("cut.speeds[].power_w", "power of the cut", "W", POWER, 100.0, 2e6),
    q("cut.speeds[].feed_m_per_s", "feed", "m/s", FEED, 1e-5, 10.0),
    q("side_force.force_n", "constant side force", "N", Span::closed(-1e6, 1e6), -1e5, 1e5)
        .typically(1.0, "", 0.1, 10.0, "assumption of this program: small deflections of a linear model"),
    q("side_force.radius_m", "radius of the side force", "m", RADIUS, 0.005, 2.5).of_kind(Kind::Radius),
    q("side_force.angle_deg", "angle of the side force", "°", ANGLE, -360.0, 360.0).of_kind(Kind::Angle),
    q("side_force.oscillating_n", "amplitude of the oscillating side force", "N", Span::closed(0.0, 1e6), 1e-3, 1e4),
    q("side_force.order", "order of the oscillating side force", "", Span::closed(1.0, 1e4), 1.0, 1000.0).of_kind(Kind::Count),
    q("runup.from_rpm", "first speed of the run-up", "rpm", SPEED, 0.0, 1e5),
    q("runup.to_rpm", "last speed of the run-up", "rpm", SPEED, 30.0, 2e5)
        .typically(1.5, "times the operating speed", 1.2, 2.0, "assumption of this program"),
    // The paper's experiment took 1600 s.
    q("runup.duration_s", "duration of the run-up", "s", Span::closed(0.01, 3600.0), 0.0, 3600.0)
        .typically(60.0, "", 5.0, 120.0, "assumption of this program"),
    q("response.runout_m", "run-out of the rim", "m", Span::closed(0.0, 1.0), 1e-6, 5e-3),
    q("response.flatness_m", "lack of flatness at the rim", "m", Span::closed(0.0, 1.0), 1e-6, 5e-3),
    q("response.imbalance_kg_m2", "imbalance beside the middle plane", "kg·m²", Span::closed(0.0, 1e3), 1e-9, 1.0),
    q("probe.radius_m", "radius of the probe", "m", RADIUS, 0.005, 2.5).of_kind(Kind::Radius),
    q("probe.angle_deg", "angle of the probe", "°", ANGLE, -360.0, 360.0).of_kind(Kind::Angle),
    q("measured.rows[].rpm", "rotation speed", "rpm", SPEED, 0.0, 1e5),
    q("measured.rows[].diameters[]", "number of nodal diameters", "", Span::closed(0.0, 300.0), 0.0, 60.0).of_kind(Kind::Count),
    // No vibration of a blade is faster.
    q("measured.rows[].frequencies_hz[]", "frequency", "Hz", Span::closed(0.0, 1e9), 0.0, 1e5),
];

/// Units by the ends of names, which also the paths of the table have. The longest one counts.
const ENDINGS: [(&str, &str); 13] = [
    ("_n_m_per_rad_per_m", "N·m/(rad·m)"),
    ("_n_s_per_m", "N·s/m"),
    ("_n_per_m", "N/m"),
    ("_m_per_s", "m/s"),
    ("_per_s", "1/s"),
    ("rpm", "rpm"),
    ("_deg", "°"),
    ("_hz", "Hz"),
    ("_m", "m"),
    ("_n", "N"),
    ("_s", "s"),
    ("_w", "W"),
    ("_db", "dB"),
];

impl Quantity {
    /// The quantity of a path such as `guides[0].radius_m`; `None` if scenes have no such number.
    pub fn of(path: &str) -> Option<&'static Self> {
        let general = general(path);
        QUANTITIES.iter().find(|quantity| quantity.path == general)
    }

    /// The unit of the number at a path or of an argument, whose name ends in its unit; empty for a number without one.
    pub fn unit_of(name: &str) -> &'static str {
        let ending = || ENDINGS.iter().find(|(ending, _)| name.ends_with(ending));
        match Self::of(name) {
            Some(quantity) => quantity.unit,
            None => ending().map_or("", |(_, unit)| unit),
        }
    }

    /// The kind of the number at a path.
    pub fn kind_of(path: &str) -> Kind {
        Self::of(path).map_or(Kind::Other, |quantity| quantity.kind)
    }
}

/// The quantity with this path, with `[]` for indices. Use it in constants: then a path that is not in the table does not
/// compile.
pub(crate) const fn quantity(path: &str) -> Quantity {
    let mut k = 0;
    while k < QUANTITIES.len() {
        if is_same(QUANTITIES[k].path, path) {
            return QUANTITIES[k];
        }
        k += 1;
    }
    panic!("the table of quantities has no such path")
}

/// Whether two texts are equal, for constants.
const fn is_same(one: &str, other: &str) -> bool {
    let (one, other) = (one.as_bytes(), other.as_bytes());
    let (mut k, mut same) = (0, one.len() == other.len());
    while same && k < one.len() {
        same = one[k] == other[k];
        k += 1;
    }
    same
}

/// The typical value of the quantity with this path, for constants.
pub(crate) const fn typical_value(path: &str) -> f64 {
    match quantity(path).typical {
        Some(typical) => typical.value,
        None => panic!("the quantity has no typical value"),
    }
}

/// A path with `[]` for the index of a list.
pub(super) fn general(path: &str) -> String {
    let mut general = String::new();
    let mut inside = false;
    for character in path.chars() {
        inside &= character != ']';
        if !inside {
            general.push(character);
        }
        inside |= character == '[';
    }
    general
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::json_schema;
    use crate::model::scene::schema::keys;

    #[test]
    fn kinds_follow_from_the_last_key_and_from_guides() {
        let kinds = [
            ("guides[2].radius_m", Kind::GuideRadius),
            ("probe.radius_m", Kind::Radius),
            ("cut.angle_deg", Kind::Angle),
            ("cut.wood.stiffness_n_per_m", Kind::Stiffness),
            ("guides[0].damping_n_s_per_m", Kind::Damping),
            ("blade.thickness_m", Kind::Other),
        ];
        for (path, kind) in kinds {
            assert_eq!(Quantity::kind_of(path), kind, "{path}");
        }
        // A number that is added to the table has the kind of those with the same last key.
        for (k, one) in QUANTITIES.iter().enumerate() {
            let last = |quantity: &Quantity| quantity.path.rsplit('.').next();
            let is_guide = |quantity: &Quantity| quantity.kind == Kind::GuideRadius;
            let alike = QUANTITIES[..k]
                .iter()
                .filter(|other| last(other) == last(one));
            for other in alike.filter(|other| !is_guide(other) && !is_guide(one)) {
                assert_eq!(one.kind, other.kind, "{} {}", one.path, other.path);
            }
        }
    }

    #[test]
    fn the_end_of_a_name_is_its_unit() {
        let mut known = 0;
        for quantity in QUANTITIES {
            let path = quantity.path.trim_end_matches("[]");
            if let Some((_, unit)) = ENDINGS.iter().find(|(ending, _)| path.ends_with(ending)) {
                assert_eq!(*unit, quantity.unit, "{path}");
                known += 1;
            }
        }
        assert!(known > 60, "{known}");
    }

    #[test]
    fn the_table_has_the_numbers_of_the_schema_and_no_others() {
        let schema = json_schema();
        let is_of = |path: &str, kind: &str| {
            let key = keys(&schema).into_iter().find(|key| key.path == path);
            let node = key.and_then(|key| schema.pointer(&key.pointer).cloned());
            node.is_some_and(|node| node["type"] == kind || node["type"][0] == kind)
        };
        let mut of_schema: Vec<String> = keys(&schema).into_iter().map(|key| key.path).collect();
        of_schema.retain(|path| is_of(path, "number") || is_of(path, "integer"));
        let mut of_table: Vec<String> = QUANTITIES.iter().map(|q| q.path.to_owned()).collect();
        of_schema.sort();
        of_table.sort();
        assert_eq!(of_table, of_schema);
        for quantity in QUANTITIES {
            let is_count = quantity.kind == Kind::Count;
            assert_eq!(
                is_of(quantity.path, "integer"),
                is_count,
                "{}",
                quantity.path
            );
        }
    }

    #[test]
    fn usual_and_typical_values_are_allowed_and_usual() {
        for quantity in QUANTITIES {
            let path = quantity.path;
            for end in [quantity.usual.0, quantity.usual.1] {
                assert!(
                    end == 0.0 || quantity.allowed.contains(end),
                    "{path}: {end}"
                );
            }
            let Some(typical) = quantity.typical else {
                continue;
            };
            let (low, high) = typical.common;
            assert!((low..=high).contains(&typical.value), "{path}");
            for value in [typical.value, low, high] {
                assert!(
                    !typical.is_number() || quantity.is_usual(value),
                    "{path}: {value}"
                );
            }
        }
    }

    #[test]
    fn a_quantity_is_found_by_the_path_of_an_error() {
        let radius = Quantity::of("guides[12].radius_m").unwrap();
        assert_eq!((radius.name, radius.unit), ("radius of the guide", "m"));
        assert!(Quantity::of("measured.rows[0].frequencies_hz[3]").is_some());
        assert!(Quantity::of("guides[0]").is_none());
    }
}
