//! A report as prose, section by section.

use std::fmt;

use linkage_runtime::circuits::CurveEnd;
use linkage_runtime::extremes::{Extreme, Extremes};
use linkage_runtime::range_of_motion::MotionEnd;
use linkage_runtime::{BorrowedName, RangeEnd};

use super::strokes::SAME;
use super::{
    DyadKind, FourBarLoop, GrashofClass, ListedMode, ListedMotion, Mobility, Modes, MotionReport, QuantityReport,
    Report, ReportedModes, SingularInput, Transmission,
};
use crate::sheet::number;

/// A heading and its paragraphs.
pub(super) struct Section {
    pub(super) heading: &'static str,
    pub(super) paragraphs: Vec<String>,
}

/// The headings that a page adds something to.
pub(super) const OUTPUTS: &str = "Outputs";
const CLASS: &str = "Grashof's class";
pub(super) const MODES: &str = "Modes and circuits";

/// Writes inputs and values of one mechanism.
struct Writer<'a, N: BorrowedName> {
    report: &'a Report<N>,
    /// The name of the input, of a mechanism with one.
    input: &'a str,
    is_angle: bool,
    /// True if the motion closes after one turn of the input: then angles are written from 0 to 360 degrees.
    is_turn: bool,
}

/// The sections of a report.
pub(super) fn sections<N: BorrowedName>(report: &Report<N>) -> Vec<Section> {
    let first = report.inputs.first();
    let writer = Writer {
        report,
        input: first.map_or("", |input| &input.name),
        is_angle: first.is_some_and(|input| input.is_angle),
        is_turn: report.motion.as_ref().is_some_and(|motion| motion.ends[1] == MotionEnd::Closed { turns: 1 }),
    };
    let section = |heading, paragraphs| Section { heading, paragraphs };
    let mut sections = vec![section("Mobility", writer.mobility(&report.mobility)), section(MODES, writer.modes())];
    if !report.four_bars.is_empty() {
        sections.push(section(CLASS, writer.classes(&report.four_bars)));
    }
    match &report.motion {
        None if report.inputs.len() == 1 => {
            let why = report.no_motion.as_ref().map_or(String::new(), |why| format!(": {why}"));
            sections.push(section("Motion", vec![format!("This report follows no motion{why}.")]));
        }
        None => {
            let why = format!(
                "With {} a mechanism has as many motions as paths of its inputs: follow one of them as a mechanism \
                 `Along` a path for its ends, extremes and transmission angles.",
                counted(report.inputs.len(), "input", "inputs"),
            );
            sections.push(section("Motion", vec![why]));
        }
        Some(motion) => {
            let passed_over =
                report.no_motion.iter().map(|why| format!("No motion is followed from the modes before: {why}."));
            sections.push(section("Motion", writer.motion(motion).into_iter().chain(passed_over).collect()));
            sections.push(section(CLASS, writer.classes(&motion.four_bars)));
            sections.push(section("Transmission angles", writer.transmission(motion)));
            let (outputs, unknowns) = motion.quantities.iter().partition::<Vec<_>, _>(|quantity| quantity.is_output);
            let with_strokes = |all: &[&QuantityReport]| all.iter().map(|one| writer.quantity(one, motion)).collect();
            if outputs.is_empty() {
                sections.push(section(OUTPUTS, with_strokes(&unknowns)));
            } else {
                sections.push(section(OUTPUTS, with_strokes(&outputs)));
                let only_extremes = unknowns.iter().map(|one| format!("{}.", writer.extremes(one, motion)));
                sections.push(section("Unknowns", only_extremes.collect()));
            }
        }
    }
    sections
}

impl<N: BorrowedName> Writer<'_, N> {
    fn mobility(&self, mobility: &Mobility) -> Vec<String> {
        let drivers = list(self.report.inputs.iter().map(|input| input.name.as_str()));
        let mut paragraphs = Vec::new();
        match &mobility.chain {
            Some(chain) => {
                let (n, j) = (chain.links.len(), chain.turning + chain.sliding);
                let conditions = match chain.conditions {
                    0 => String::new(),
                    conditions => format!(
                        ", and {} between coordinates {}",
                        counted(conditions, "condition", "conditions"),
                        if conditions == 1 { "holds" } else { "hold" }
                    ),
                };
                let less = if chain.conditions == 0 { String::new() } else { format!(" − {}", chain.conditions) };
                let joints = match (chain.turning, chain.sliding) {
                    (_, 0) => "all of which turn".to_owned(),
                    (0, _) => "all of which slide".to_owned(),
                    (turning, sliding) => format!("of which {turning} turn and {sliding} slide"),
                };
                paragraphs.push(format!(
                    "{} ({}) meet in {}, {joints}. They form {}{conditions}. The count of Chebyshev, Grübler and Kutzbach \
                     is 3·({n} − 1) − 2·{j}{less} = {}.",
                    counted(n, "link", "links"),
                    list(chain.links.iter().map(String::as_str)),
                    counted(j, "joint", "joints"),
                    counted(chain.loops, "loop", "loops"),
                    chain.count,
                ));
                paragraphs.push(match chain.redundant {
                    0 => "No constraint is redundant.".to_owned(),
                    redundant => format!(
                        "{} redundant: {} moves in spite of the count, because of its dimensions.",
                        if redundant == 1 {
                            "1 constraint is".to_owned()
                        } else {
                            format!("{redundant} constraints are")
                        },
                        self.report.mechanism,
                    ),
                });
            }
            None if mobility.equations > 0 => {
                paragraphs
                    .push("The loops do not show all links and joints, so that these are not counted.".to_owned());
            }
            None => {}
        }
        let implied = match mobility.implied {
            0 => String::new(),
            implied => format!(
                "; {} from them",
                if implied == 1 { "1 more follows".to_owned() } else { format!("{implied} more follow") }
            ),
        };
        let which = if mobility.degrees_of_freedom == 1 { "drives it" } else { "drive them" };
        paragraphs.push(format!(
            "{} and {}{implied} leave {}: {drivers} {which}.",
            counted(mobility.coordinates, "coordinate", "coordinates"),
            counted(mobility.equations, "equation", "equations"),
            counted(mobility.degrees_of_freedom, "degree of freedom", "degrees of freedom"),
        ));
        paragraphs
    }

    fn modes(&self) -> Vec<String> {
        match &self.report.modes {
            ReportedModes::NotListed => vec!["The positions are not listed.".to_owned()],
            ReportedModes::Missing(why) => vec![format!("The modes are not known: {why}.")],
            ReportedModes::Failed(error) => vec![format!("The modes and circuits are not known: {error}.")],
            ReportedModes::Listed(modes) => self.listed(modes),
        }
    }

    fn listed(&self, modes: &Modes) -> Vec<String> {
        let inputs = self.report.inputs.iter().zip(&modes.inputs);
        let at = list_of(inputs.map(|(input, &value)| format!("{} = {}", input.name, written(value, input.is_angle))));
        let (count, left_out) = (modes.modes.len(), modes.left_out);
        if count == 0 {
            return vec![format!("At {at} there is no mode in the declared ranges.")];
        }
        let are = if count == 1 { "is" } else { "are" };
        let on = match modes.motions.len() {
            0 => String::new(),
            motions => format!(
                " on {}, which {} {}",
                counted(motions, "motion", "motions"),
                if motions == 1 { "forms" } else { "form" },
                counted(modes.circuits.len(), "circuit", "circuits"),
            ),
        };
        let mut paragraphs = vec![format!("At {at} there {are} {}{on}.", counted(count, "mode", "modes"))];
        if left_out > 0 {
            paragraphs[0] = format!(
                "At {at} the first {} are listed{on}; up to {left_out} more are left out.",
                counted(count, "mode", "modes")
            );
        }
        let not_followed = modes.modes.iter().filter(|mode| mode.motion.is_none()).count();
        if !modes.motions.is_empty() && not_followed > 0 && modes.not_followed.is_none() {
            paragraphs.push(format!(
                "The motions through {} of them are not followed.",
                if not_followed == 1 { "one".to_owned() } else { not_followed.to_string() }
            ));
        }
        paragraphs.extend(modes.not_followed.iter().map(|why| format!("Not all motions are known: {why}.")));
        paragraphs.extend(modes.modes.iter().zip(1..).map(|(mode, number)| self.mode(mode, number)));
        let followed = modes.followed.filter(|_| self.report.motion.is_some());
        let followed = followed.and_then(|mode| modes.modes.get(mode)?.motion);
        for (place, circuit) in modes.circuits.iter().enumerate() {
            for &at in circuit {
                let Some(motion) = modes.motions.get(at) else { continue };
                let of_motion = modes.modes.iter().enumerate().filter(|(_, mode)| mode.motion == Some(at));
                let numbers: Vec<String> = of_motion.map(|(number, _)| (number + 1).to_string()).collect();
                let followed = if Some(at) == followed { ", which this report follows" } else { "" };
                paragraphs.push(format!(
                    "Circuit {}: mode{} {}{followed}. {}",
                    place + 1,
                    if numbers.len() == 1 { "" } else { "s" },
                    list_of(numbers.into_iter()),
                    self.of_circuit(motion),
                ));
            }
        }
        paragraphs
    }

    /// A mode with its unknowns.
    fn mode(&self, mode: &ListedMode, number: usize) -> String {
        let unknowns = self.report.unknowns.iter().zip(&mode.unknowns);
        let values =
            unknowns.map(|(unknown, &value)| format!("{} = {}", unknown.name, written(value, unknown.is_angle)));
        let branch = if mode.branch.is_empty() { String::new() } else { format!(" ({})", mode.branch) };
        let angles = mode.transmission.iter().map(|(group, angle)| {
            let angle = in_degrees((angle.to_degrees() * 1e6).round() / 1e6);
            format!(" The transmission angle of {group} is {angle}.")
        });
        format!("Mode {number}{branch}: {}.{}", list_of(values), angles.collect::<String>())
    }

    fn of_circuit(&self, motion: &ListedMotion) -> String {
        let Self { input, .. } = self;
        let way = match motion.end {
            CurveEnd::Closed { .. } if motion.full_turns != 0 => {
                let turns = motion.full_turns.unsigned_abs() as usize;
                format!("{input} turns fully, and the motion closes after {}", counted(turns, "turn", "turns"))
            }
            CurveEnd::Closed { .. } => format!("{input} goes to and fro {}", self.between(motion.range)),
            CurveEnd::Limits => format!("{input} goes {} and ends at limits of its range", self.between(motion.range)),
            CurveEnd::Open => format!("the motion does not close {}", self.between(motion.range)),
        };
        // Where it turns fully all turns are the same; else inputs are in the range that is written.
        let at = |input: f64| if motion.full_turns != 0 { self.at(input) } else { self.exactly(input) };
        let dead = self.singular(&motion.dead_points, ["dead point", "dead points"], at);
        let change = self.singular(&motion.change_points, ["change point", "change points"], at);
        let sentence = capital(&way);
        format!("{sentence}; {dead}, {change}.")
    }

    /// "2 dead points, at theta = 30° (phi, psi) and 120° (phi, psi)", or "no dead point".
    fn singular(&self, all: &[SingularInput], [one, several]: [&str; 2], at: impl Fn(f64) -> String) -> String {
        if all.is_empty() {
            return format!("no {one}");
        }
        let places = all.iter().map(|of| format!("{} ({})", at(of.input), of.groups.join("; ")));
        format!("{} at {} = {}", counted(all.len(), one, several), self.input, list_of(places))
    }

    fn motion(&self, motion: &MotionReport<N>) -> Vec<String> {
        let [low, high] = motion.range.map(|input| self.at(input));
        let Self { input, .. } = self;
        let mut paragraphs = vec![match motion.ends {
            [_, MotionEnd::Closed { turns: 0 }] => "The motion closes.".to_owned(),
            [_, MotionEnd::Closed { turns }] => format!(
                "{input} turns fully, without limits: the motion closes after {}.",
                counted(turns as usize, "turn", "turns")
            ),
            [MotionEnd::DeadPoint { group: lower }, MotionEnd::DeadPoint { group: upper }] if lower == upper => {
                format!("{input} goes from {low} to {high}. Both ends are dead points of {lower}.")
            }
            [lower, upper] => {
                let of_angle = if self.is_angle { " It does not turn fully." } else { "" };
                format!(
                    "{input} goes from {low} to {high}.{of_angle} The lower end is {}, the upper end is {}.",
                    end(lower),
                    end(upper)
                )
            }
        }];
        let crossings = self.singular(&motion.change_points, ["change point", "change points"], |input| self.at(input));
        let near = motion.near_misses.iter().map(|miss| {
            format!("{} (at a distance of about {})", self.at(miss.input), number(two_digits(miss.regularity)))
        });
        let near: Vec<String> = near.collect();
        let near = if near.is_empty() {
            "near no other".to_owned()
        } else {
            format!("near others that it does not meet at {input} = {}", list_of(near.into_iter()))
        };
        paragraphs.push(format!("It passes {crossings}, and {near}."));
        paragraphs
    }

    fn classes(&self, four_bars: &[FourBarLoop]) -> Vec<String> {
        if four_bars.is_empty() {
            return vec!["No loop of four turning joints is found: there is no Grashof class.".to_owned()];
        }
        let class = |four_bar: &FourBarLoop| {
            let FourBarLoop { links: [driving, coupler, output], lengths, class, margin } = four_bar;
            let [ground, first, second, third] = lengths.map(number);
            let law = match class {
                GrashofClass::ChangePoint => "the shortest and the longest are together as long as the others",
                GrashofClass::TripleRocker => "the shortest and the longest are together longer than the others",
                _ => "the shortest and the longest are together shorter than the others",
            };
            let by = match class {
                GrashofClass::ChangePoint => String::new(),
                _ => format!(" by {} % of the sum of all", number(two_digits(100.0 * margin.abs()))),
            };
            format!(
                "The loop of the ground ({ground}), {driving} ({first}), {coupler} ({second}) and {output} ({third}) is a \
                 {class}, seen from {driving}: {law}{by}."
            )
        };
        four_bars.iter().map(class).collect()
    }

    fn transmission(&self, motion: &MotionReport<N>) -> Vec<String> {
        let mut paragraphs: Vec<String> = motion.transmission.iter().map(|dyad| self.of_dyad(dyad)).collect();
        paragraphs.extend(
            motion
                .without_transmission
                .iter()
                .map(|group| format!("The group {} has no transmission angle: {}.", group.group, group.kind)),
        );
        if paragraphs.is_empty() {
            paragraphs.push("There is no dyad.".to_owned());
        }
        paragraphs
    }

    fn of_dyad(&self, dyad: &Transmission) -> String {
        let Transmission { group, kind, between, least, .. } = dyad;
        // Next to a singular position an angle has the square root of a rounding error.
        let written = |angle: f64| in_degrees((angle.to_degrees() * 1e6).round() / 1e6);
        let of = match kind {
            DyadKind::Rrr => "the angle between both links",
            DyadKind::Rrp => "the angle between the link and the normal of the guide",
            DyadKind::Rpr => "the angle between the slot and the normal of its arm",
            DyadKind::Sliders => "the angle between both guides",
        };
        let acute = format!(
            "The transmission angle is at least {} (at {} = {})",
            written(least.value),
            self.input,
            self.at(least.input)
        );
        let [worst, best] = [least.value, dyad.largest.value].map(written);
        match between {
            _ if worst == best => format!("Dyad {group}: the transmission angle, {of}, is {worst} all the time."),
            Some(Extremes { least, largest }) => {
                let texts = [least.value, largest.value].map(written);
                format!("Dyad {group}: {of} goes {}. {acute}.", self.extent([least.input, largest.input], texts))
            }
            None => format!("Dyad {group}: {}, {of}; at most {best}.", acute.replacen("The", "the", 1)),
        }
    }

    fn quantity(&self, quantity: &QuantityReport, motion: &MotionReport<N>) -> String {
        let QuantityReport { strokes, dwells, .. } = quantity;
        let written = |at: Extreme| valued(at, quantity);
        let mut text = self.extremes(quantity, motion);
        if quantity.is_constant {
            text.push('.');
            return text;
        }
        text.push_str(match (motion.is_closed(), strokes.len()) {
            (true, 0) => ", and moves in one direction all the time.",
            _ => ".",
        });
        if motion.is_closed() || strokes.len() > 1 {
            for stroke in strokes {
                text.push_str(&format!(
                    " From {} to {} it moves from {} to {}, in {} % of the motion.",
                    self.at(stroke.from.input),
                    self.at(stroke.to.input),
                    written(stroke.from),
                    written(stroke.to),
                    number(percent(stroke.share)),
                ));
            }
        }
        if let Some(ratio) = quantity.time_ratio {
            text.push_str(&format!(" The time ratio of both strokes is {}.", number(ratio)));
        }
        if dwells.is_empty() {
            text.push_str(" It has no dwell.");
        }
        for dwell in dwells {
            let [low, high] = dwell.values.map(|value| written(Extreme { input: dwell.from, value }));
            text.push_str(&format!(
                " It dwells between {low} and {high} from {} to {}, in {} % of the motion.",
                self.at(dwell.from),
                self.at(dwell.to),
                number(percent(dwell.share)),
            ));
        }
        text
    }

    /// "psi goes from 3° (at theta = 0°) to 7° (at theta = 30°)"; of an angle that turns by how much.
    fn extremes(&self, quantity: &QuantityReport, motion: &MotionReport<N>) -> String {
        let QuantityReport { name, extremes: Extremes { least, largest }, .. } = quantity;
        if quantity.is_constant {
            return format!("{name} is {} all the time", valued(*least, quantity));
        }
        if let Some(turned) = quantity.turned().filter(|_| motion.is_closed()) {
            return format!("{name} turns by {} each time the motion closes", written(turned, true));
        }
        let texts = [*least, *largest].map(|at| valued(at, quantity));
        format!("{name} goes {}", self.extent([least.input, largest.input], texts))
    }

    fn extent(&self, inputs: [f64; 2], [least, largest]: [String; 2]) -> String {
        let [first, second] = inputs.map(|input| self.at(input));
        format!("from {least} (at {input} = {first}) to {largest} (at {input} = {second})", input = self.input)
    }

    /// Ends of the input in their order, which are not on other turns of an angle.
    fn between(&self, ends: [f64; 2]) -> String {
        let [low, high] = ends.map(|end| self.exactly(end));
        format!("between {low} and {high}")
    }

    /// A value of the input.
    fn at(&self, input: f64) -> String {
        if self.is_turn && self.is_angle {
            in_degrees(rounded(input.to_degrees()).rem_euclid(360.0))
        } else {
            self.exactly(input)
        }
    }

    /// A value of the input with its turns; 0 where it is zero up to rounding errors of the ends of the motion.
    fn exactly(&self, input: f64) -> String {
        let ends = self.report.motion.iter().flat_map(|motion| motion.range);
        let scale = ends.fold(0.0, |scale: f64, end| scale.max(end.abs()));
        written(if input.abs() <= 8.0 * f64::EPSILON * scale { 0.0 } else { input }, self.is_angle)
    }
}

pub(crate) fn end<N: BorrowedName>(end: MotionEnd<N>) -> String {
    match end {
        MotionEnd::Range => "that of the range that was asked for".to_owned(),
        MotionEnd::JointRange { of, end } => {
            format!(
                "the {} value of {of}, an end of its range",
                if end == RangeEnd::Least { "least" } else { "largest" }
            )
        }
        MotionEnd::DeadPoint { group } => format!("a dead point of {group}"),
        MotionEnd::ChangePoint { groups } => {
            format!(
                "a change point of {}, where other motions cross",
                groups.iter().map(|group| group.to_string()).collect::<Vec<_>>().join("; ")
            )
        }
        MotionEnd::Closed { .. } => "its start".to_owned(),
        MotionEnd::Open => "no limit: the motion goes on, and was left there".to_owned(),
    }
}

/// A value, an angle in degrees to 1e-9.
pub(crate) fn written(value: f64, is_angle: bool) -> String {
    if is_angle { in_degrees(rounded(value.to_degrees())) } else { number(value) }
}

/// A value of a quantity at an input; 0 where it is zero up to rounding errors.
fn valued(Extreme { input, value }: Extreme, quantity: &QuantityReport) -> String {
    let is_zero = value.abs() <= SAME * quantity.resolution_at(input);
    written(if is_zero { 0.0 } else { value }, quantity.is_angle)
}

fn in_degrees(degrees: f64) -> String {
    format!("{}°", number(degrees))
}

fn rounded(degrees: f64) -> f64 {
    (degrees * 1e9).round() / 1e9
}

/// A share in percent, with two decimals.
fn percent(share: f64) -> f64 {
    (share * 1e4).round() / 1e2
}

/// A number rounded to two digits.
fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

fn counted(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}

fn list<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<Vec<_>>().join(", ")
}

/// "a, b and c".
fn list_of(texts: impl Iterator<Item = String>) -> String {
    let texts: Vec<String> = texts.collect();
    match texts.split_last() {
        Some((last, before)) if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        Some((last, _)) => last.clone(),
        None => String::new(),
    }
}

/// The text with a capital at the start, unless that is the name of a coordinate.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    match text.starts_with("the ") {
        true => letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect()),
        false => text.to_owned(),
    }
}

/// The report as prose.
impl<N: BorrowedName> fmt::Display for Report<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.mechanism)?;
        for Section { heading, paragraphs } in sections(self) {
            writeln!(f, "\n{heading}")?;
            for paragraph in paragraphs {
                writeln!(f, "{paragraph}")?;
            }
        }
        Ok(())
    }
}
