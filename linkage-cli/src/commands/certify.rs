//! `linkage certify`: a proof that a motion exists, is one and has no singular position.

use linkage_interpreter::{CertifiableAtRunTime, CoordinatesAtRunTime, NotPrepared};
use linkage_interval::Interval;
use linkage_interval::certify::{
    Certificate, CertifiedRange, Certify, CertifyError, Curve, Enclosure, End, RangeProof,
};
use linkage_runtime::{Column, RangeEnd};
use serde::Serialize;

use super::list::moving;
use crate::aligned::aligned;
use crate::arguments;
use crate::ends::shown;
use crate::failure::Failure;
use crate::machine::Machine;
use crate::motion::{held, usual_ends};
use crate::one_input::{Inputs, prepared};
use crate::progress;
use crate::proved::{ends, largest, least, proved};

/// The mechanism of a certificate.
type Certified<'p> = CertifiableAtRunTime<'p, Inputs>;

pub fn run(arguments: &arguments::Certify) -> Result<(), Failure> {
    let arguments::Certify { numbers, place, along, from, form, .. } = arguments;
    let format = form.format("a certificate")?;
    let machine = Machine::with_intervals(numbers)?;
    let moving = moving(&machine, along.as_deref())?;
    let input = &machine.about.inputs[moving];
    let name = &input.name.text;
    if from.is_some() && place.at.iter().any(|at| at.name == *name) {
        return Err(Failure::Argument(format!("--at {name} and --from are both the first value: leave out one")));
    }
    let is_whole = arguments.curve || arguments.turns.is_some();
    // An angle whose range has one end goes over a turn to it, or from it, as in a table.
    let has_range = !is_whole && machine.declared(moving).iter().any(Option::is_some);
    let [least, most] = if has_range { usual_ends(&machine, moving) } else { [None; 2] };
    let to = arguments.to.map(|value| input.value(value)).transpose()?;
    let is_free = to.is_none() && place.at.iter().all(|at| at.name != *name);
    let first = from.map(|value| input.value(value)).transpose()?.or(least.filter(|_| is_free));
    let inputs = held(&machine, &place.at, first.map(|first| (moving, first)))?;
    let to = to.or(most);
    match to {
        None if !input.is_angle && !arguments.curve => {
            let what = if input.is_length { "length" } else { "number" };
            let message = format!("`{name}` is a {what} and has no turn: write --to VALUE, or --curve");
            return Err(Failure::Argument(message));
        }
        Some(to) if to == inputs[moving] => {
            return Err(Failure::Argument(format!("--to is the first value of `{name}`")));
        }
        _ => {}
    }
    let prepared = prepared(&machine)?;
    let outside = |error: NotPrepared| Failure::Outside(error.to_string());
    let mechanism: Certified<'_> = prepared.certifiable().map_err(outside)?;
    let asked = Asked { machine: &machine, inputs: &inputs, moving, to };
    let proof = progress::during("certifying".to_owned(), || asked.proof(&mechanism, arguments));
    if let Some(failure) = prepared.failure() {
        return Err(Failure::Outside(failure.to_string()));
    }
    form.write(format, &proof?, Proof::to_text, &numbers.source.file)
}

/// The motion that is asked for.
struct Asked<'a> {
    machine: &'a Machine,
    inputs: &'a [f64],
    moving: usize,
    /// The last value of the input, instead of turns.
    to: Option<f64>,
}

impl Asked<'_> {
    fn proof(&self, mechanism: &Certified<'_>, arguments: &arguments::Certify) -> Result<Proof, Failure> {
        let at = |unknowns: &[f64]| -> Option<CoordinatesAtRunTime<Inputs>> {
            let inputs = Column::from_slice(self.inputs)?;
            Some(CoordinatesAtRunTime { unknowns: Column::from_slice(unknowns)?, inputs })
        };
        let unknowns = self.machine.place(self.inputs, &vec![0.0; self.inputs.len()]).map_err(Failure::Outside)?;
        let start = at(&unknowns).ok_or_else(|| Failure::Outside("too many numbers".to_owned()))?;
        // The motion may arrive at another one; not all mechanisms have a list.
        let others = self.machine.positions(self.inputs).unwrap_or_default();
        let mut certify = Certify::new(mechanism).input(self.moving).turns(arguments.turns.unwrap_or(1));
        if let Some(part) = arguments.tolerance {
            certify = certify.tolerance(part.0);
        }
        if arguments.curve {
            let curve = certify.curve(&start).map_err(|error| self.refused(&error))?;
            return Ok(self.of_curve(&curve));
        }
        let certify = certify.positions(others.iter().filter_map(|(_, motion)| at(&motion.unknowns)));
        let certificate = match self.to {
            Some(to) => certify.range(&start, to),
            None => certify.turn(&start),
        };
        let certificate = certificate.map_err(|error| self.refused(&error))?;
        let branches: Vec<&str> = others.iter().map(|(branch, _)| branch.as_str()).collect();
        Ok(self.of_certificate(&certificate, &branches))
    }

    /// The reason why there is no proof, with the input in its unit.
    fn refused(&self, error: &CertifyError<&str>) -> Failure {
        let input = &self.machine.about.inputs[self.moving];
        let (name, shown) = (&input.name.text, |value: f64| shown(value, input.is_angle));
        let between = |of: &Interval| match [of.least(), of.most()].map(shown) {
            [one, other] if one == other => format!("at {name} = {one}"),
            _ => {
                let [least, most] = ends(*of, input.is_angle);
                format!("between {name} = {least} and {most}")
            }
        };
        Failure::Outside(match error {
            CertifyError::DeadPoint { group, limit, .. } => {
                let at = proved(*limit, input.is_angle);
                format!("not certified: {name} turns back at {at}, a dead point of {group}; --curve goes through it")
            }
            CertifyError::NoPosition { group, .. } => {
                let at = self.machine.at(self.inputs);
                format!(
                    "not certified: {at} is a dead point or a change point of {group}, or nearly so: write another --at"
                )
            }
            CertifyError::Singular { group, input, .. } => {
                let at = between(input);
                format!("not certified: {at} there is a change point or a dead point of {group}, or nearly so")
            }
            CertifyError::NoBounds { group, input, .. } => {
                format!("not certified: the equations of {group} jump or have a kink or a pole {}", between(input))
            }
            CertifyError::Undecided { input, .. } => {
                format!("not certified: the bounds are too wide {}", between(input))
            }
            CertifyError::NoTurn { .. } => {
                format!("not certified: no sine of `{name}` is taken, so that it has no turn: write --to VALUE")
            }
            CertifyError::Exhausted { boxes, input, .. } => {
                format!(
                    "not certified beyond {name} = {}: the work is bounded, and {boxes} boxes took it",
                    shown(*input)
                )
            }
            other => format!("not certified: {other}"),
        })
    }

    fn of_certificate(&self, certificate: &Certificate<Certified<'_>>, branches: &[&str]) -> Proof {
        let input = &self.machine.about.inputs[self.moving];
        let end = match certificate.end() {
            End::Closed { turns } => Arrival::Closed { turns: turns.clone() },
            End::Arrives { position, turns } => {
                let branch = branches.get(*position).copied().unwrap_or_default().to_owned();
                Arrival::Arrives { position: *position, branch, turns: turns.clone() }
            }
            End::Open => Arrival::Open,
        };
        let ratios = certificate.velocity_ratios();
        let names = self.machine.about.unknowns.iter().map(|of| format!("d {} / d {}", of.name.text, input.name.text));
        let inputs = certificate.inputs();
        Proof {
            inputs: Some([inputs.least(), inputs.most()]),
            end: Some(end),
            velocity_ratios: names.zip(&ratios).map(|(name, of)| Bounds::of(name, of, false)).collect(),
            ..self.of(
                certificate.to_string(),
                certificate.boxes(),
                |place| certificate.quantity(place),
                |place| certificate.quantity_on_turns(place),
                certificate.joint_ranges(),
            )
        }
    }

    fn of_curve(&self, curve: &Curve<Certified<'_>>) -> Proof {
        let dead_points = curve.dead_points().iter().map(|at| DeadPoint {
            input: [at.input.least(), at.input.most()],
            group: at.group.to_owned(),
            is_largest: at.is_largest,
        });
        Proof {
            dead_points: dead_points.collect(),
            ..self.of(
                curve.to_string(),
                curve.boxes(),
                |place| curve.quantity(place),
                |place| curve.quantity_on_turns(place),
                curve.joint_ranges(),
            )
        }
    }

    /// The proof with bounds of all quantities: of those whose formula jumps, as `atan2` does, the bounds on turns where they are
    /// known.
    fn of(
        &self,
        statement: String,
        boxes: usize,
        quantity: impl Fn(usize) -> Option<Enclosure>,
        on_turns: impl Fn(usize) -> Option<Enclosure>,
        ranges: Vec<CertifiedRange<&str>>,
    ) -> Proof {
        let about = &self.machine.about;
        let points = about.points.iter().flat_map(|of| ["x", "y"].map(|axis| (format!("{}_{axis}", of.text), None)));
        let outputs = about.outputs.iter().map(|of| of.text.clone()).zip(about.output_angles.iter().copied());
        let (mut quantities, mut within_a_turn) = (Vec::new(), Vec::new());
        for (place, (name, angle)) in points.chain(outputs).enumerate() {
            let angle_that_jumps = angle.filter(|angle| angle.jump.is_some() || angle.jumps_differ);
            let turned = angle_that_jumps.and_then(|_| on_turns(place));
            let Some(bounds) = turned.or_else(|| quantity(place)) else { continue };
            // From pi to -pi, each rounded.
            let is_cut = |jump: f64| bounds.values().width() >= jump * (1.0 - 4.0 * f64::EPSILON);
            if turned.is_none() && angle_that_jumps.is_some_and(|angle| angle.jump.is_none_or(is_cut)) {
                within_a_turn.push(name.clone());
            }
            quantities.push(Bounds::of(name, &bounds, angle.is_some()));
        }
        Proof {
            mechanism: about.name.clone(),
            statement,
            input: about.inputs[self.moving].name.text.clone(),
            is_angle: about.inputs[self.moving].is_angle,
            inputs: None,
            end: None,
            dead_points: Vec::new(),
            boxes,
            within_a_turn,
            quantities,
            velocity_ratios: Vec::new(),
            ranges: ranges.iter().map(|range| self.of_range(range)).collect(),
        }
    }
}

impl Asked<'_> {
    /// The proof of a range. That of the moving input needs none: the ends of the motion are numbers.
    fn of_range(&self, range: &CertifiedRange<&str>) -> Range {
        let input = &self.machine.about.inputs[self.moving];
        let Some(to) = self.to.filter(|_| range.of == input.name.text) else { return Range::of(range) };
        let from = self.inputs[self.moving];
        let [least, most] = self.machine.declared(self.moving);
        let is_within = least.is_none_or(|least| least <= from.min(to)) && most.is_none_or(|most| from.max(to) <= most);
        if is_within { Range { of: range.of.to_owned(), proof: "within" } } else { Range::of(range) }
    }
}

/// The statements that are proved about a motion.
#[derive(Serialize)]
struct Proof {
    mechanism: String,
    statement: String,
    input: String,
    is_angle: bool,
    /// The first and the last value of the input; none of a curve.
    #[serde(skip_serializing_if = "Option::is_none")]
    inputs: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    end: Option<Arrival>,
    /// Those of a curve.
    dead_points: Vec<DeadPoint>,
    boxes: usize,
    /// The outputs whose formula jumps, and of which it is not proved how they go on: their bounds are those of one turn.
    within_a_turn: Vec<String>,
    quantities: Vec<Bounds>,
    velocity_ratios: Vec<Bounds>,
    ranges: Vec<Range>,
}

/// The end of a motion over full turns.
#[derive(Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
enum Arrival {
    /// At its start again, after these full turns of the unknowns.
    Closed {
        turns: Vec<i64>,
    },
    /// At another position, by its number in the list of all at these inputs.
    Arrives {
        position: usize,
        branch: String,
        turns: Vec<i64>,
    },
    Open,
}

#[derive(Serialize)]
struct DeadPoint {
    /// They enclose the limit of the input.
    input: [f64; 2],
    group: String,
    is_largest: bool,
}

/// The least and the largest value of a quantity, each between two numbers.
#[derive(Serialize)]
struct Bounds {
    name: String,
    is_angle: bool,
    least: [f64; 2],
    largest: [f64; 2],
    is_sharp: bool,
    #[serde(skip)]
    both: [Interval; 2],
}

impl Bounds {
    fn of(name: String, of: &Enclosure, is_angle: bool) -> Self {
        let ends = |of: Interval| [of.least(), of.most()];
        let (least, largest) = (ends(of.least), ends(of.largest));
        Self { name, is_angle, least, largest, is_sharp: of.is_sharp, both: [of.least, of.largest] }
    }

    fn row(&self) -> Vec<String> {
        let [of_least, of_largest] = self.both;
        vec![self.name.clone(), least(of_least, self.is_angle), largest(of_largest, self.is_angle)]
    }
}

/// A declared range.
#[derive(Serialize)]
struct Range {
    of: String,
    proof: &'static str,
}

impl Range {
    fn of(range: &CertifiedRange<&str>) -> Self {
        let proof = match range.proof {
            RangeProof::Within => "within",
            RangeProof::Beyond(RangeEnd::Least) => "beyond_least",
            RangeProof::Beyond(RangeEnd::Most) => "beyond_largest",
            RangeProof::Undecided => "undecided",
        };
        Self { of: range.of.to_owned(), proof }
    }

    fn in_words(&self) -> String {
        let of = &self.of;
        match self.proof {
            "within" => format!("{of} stays in its range"),
            "beyond_least" => format!("{of} goes below its range"),
            "beyond_largest" => format!("{of} goes above its range"),
            _ => format!("{of} comes so near to an end of its range that nothing is proved"),
        }
    }
}

impl Proof {
    fn to_text(&self) -> String {
        let mut text = self.statement.clone() + "\n";
        if let Some(Arrival::Arrives { position, branch, .. }) = &self.end {
            text += &format!("position {position} is {branch}\n");
        }
        text += &format!("proved by {} boxes, as all digits of these numbers are\n", self.boxes);
        let dead_point = |of: &DeadPoint| {
            let input = Interval::new(of.input[0], of.input[1]).unwrap_or(Interval::ENTIRE);
            let at = match of.is_largest {
                true => format!("largest {} {}", self.input, largest(input, self.is_angle)),
                false => format!("least {} {}", self.input, least(input, self.is_angle)),
            };
            format!("{at}, a dead point of {}\n", of.group)
        };
        text.extend(self.dead_points.iter().map(dead_point));
        text.extend(self.ranges.iter().map(|range| range.in_words() + "\n"));
        if !self.quantities.is_empty() || !self.velocity_ratios.is_empty() {
            let head = ["", "least", "largest"].map(str::to_owned).to_vec();
            let rows = self.quantities.iter().chain(&self.velocity_ratios).map(Bounds::row);
            text += "\n";
            text += &aligned(std::iter::once(head).chain(rows).collect());
            text.extend(self.within_a_turn.iter().map(|name| {
                format!("{name} is an angle whose formula jumps by a turn, as near the origin, where it has no direction: these are \
                     bounds of one turn\n")
            }));
        }
        text
    }
}
