//! The words about the motion of a table or a film on standard error: positions that are missing, change points, gaps.

use std::f64::consts::TAU;

use linkage_runtime::Mechanism as _;

use crate::ends::{Reason, shown};
use crate::followed::{EQUAL, Followed, ends, passed};
use crate::machine::Machine;
use crate::one_input::coordinates;
use crate::terminal::say;

/// The most places that are named.
const NAMED: usize = 5;

impl Followed<'_> {
    /// Says on standard error how many of these rows or positions are missing, with the reason of the first, where the motion
    /// passes change points, and where it does not get across. `missing` has the values of the moving input, and the reasons.
    pub fn say(&self, missing: &[(f64, String)], of: &str) {
        if let Some((value, first)) = missing.first() {
            let is_beyond = self.range.as_ref().is_some_and(|range| range.at(*value).is_err());
            let ends = self.ends().filter(|_| is_beyond);
            let why = ends.unwrap_or_else(|| format!("the first: {first}"));
            let others = missing.iter().filter(|(value, _)| self.is_elsewhere(*value)).count();
            let count = missing.len();
            match others {
                0 => say!("{count} of {of} have no position; {why}"),
                _ => say!(
                    "{count} of {of} are not on the motion; {why}; {others} of them {} on the branch, to which it does not get",
                    if others == 1 { "has a position" } else { "have positions" }
                ),
            }
        }
        self.say_change_points();
        if missing.is_empty() {
            self.say_gaps();
        }
    }

    /// True if the branch has a position here, and the motion has none. A number of a list is no branch at other inputs.
    fn is_elsewhere(&self, value: f64) -> bool {
        let (Some(range), true) = (&self.range, self.machine.is_closed()) else { return false };
        let inputs = self.path.at(value);
        let unknowns = self.machine.place(&inputs, &vec![0.0; inputs.len()]);
        let at = unknowns.ok().and_then(|unknowns| coordinates(range.mechanism(), &unknowns, value));
        at.is_some_and(|at| range.at(value).is_err() && range.mechanism().is_within_ranges(&at).unwrap_or(false))
    }

    /// The ends of the motion in words, those within the values of the moving input; none of a motion without ends.
    fn ends(&self) -> Option<String> {
        let range = self.range.as_ref()?;
        let input = &self.machine.about.inputs[self.path.moving];
        let ends = range.inputs().into_iter().zip(ends(self.machine, range).ok()?);
        let of_end = |(at, end)| match end {
            None | Some(Reason::GoesOn) => Vec::new(),
            Some(reason) => {
                let within = self.repeated(at);
                let all = if within.is_empty() { vec![at] } else { within };
                all.into_iter().map(|at| (at, reason.in_words())).collect()
            }
        };
        let mut ends: Vec<(f64, String)> = ends.flat_map(of_end).collect();
        ends.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        if self.is_falling() {
            ends.reverse();
        }
        let more = ends.len().saturating_sub(NAMED);
        ends.truncate(NAMED);
        let (_, first) = ends.first()?.clone();
        let is_one = ends.iter().all(|(_, why)| *why == first);
        let at = |(at, why): &(f64, String)| match is_one {
            true => shown(*at, input.is_angle),
            false => format!("{} ({why})", shown(*at, input.is_angle)),
        };
        let mut all: Vec<String> = ends.iter().map(at).collect();
        all.extend((more > 0).then(|| format!("{more} more")));
        let all = match all.split_last() {
            Some((last, others)) if !others.is_empty() => format!("{} and {last}", others.join(", ")),
            _ => all.concat(),
        };
        let why = if is_one { format!(" ({first})") } else { String::new() };
        Some(format!("the motion of {} ends at {} = {all}{why}", self.machine.about.name, input.name.text))
    }

    /// True if the moving input falls.
    fn is_falling(&self) -> bool {
        self.path.ends[0] > self.path.ends[1]
    }

    /// The least and the largest value of the moving input.
    fn sorted(&self) -> [f64; 2] {
        let [from, to] = self.path.ends;
        [from.min(to), from.max(to)]
    }

    /// A value and those a number of periods away, within the values of the moving input and in the order of the way.
    fn repeated(&self, value: f64) -> Vec<f64> {
        let [least, largest] = self.sorted();
        let error = EQUAL * least.abs().max(largest.abs()).max(value.abs());
        let is_within = |value: &f64| *value >= least - error && *value <= largest + error;
        let Some(period) = self.period() else { return Some(value).filter(is_within).into_iter().collect() };
        let first = ((least - value) / period).floor();
        let count = ((largest - least) / period).ceil() as u32 + 2;
        (0..count).map(|cycle| value + (first + f64::from(cycle)) * period).filter(is_within).collect()
    }

    /// In the order of the way, without those that are the same.
    fn ordered(&self, mut values: Vec<f64>) -> Vec<f64> {
        values.sort_by(f64::total_cmp);
        values.dedup_by(|one, other| (*one - *other).abs() <= EQUAL * TAU);
        if self.is_falling() {
            values.reverse();
        }
        values
    }

    fn say_change_points(&self) {
        let Some(range) = &self.range else { return };
        let passed = passed(range).into_iter();
        let all = passed.flat_map(|input| self.repeated(input)).collect();
        let all = self.ordered(all);
        let input = &self.machine.about.inputs[self.path.moving];
        let places: Vec<String> = all.iter().take(NAMED).map(|at| shown(*at, input.is_angle)).collect();
        let more = all.len().saturating_sub(NAMED);
        let more = if more > 0 { format!(" and at {more} more") } else { String::new() };
        let kind = match all.len() {
            0 => return,
            1 => "a change point",
            _ => "change points",
        };
        say!(
            "at {} = {}{more} the motion passes {kind}: it goes on smoothly, and other motions cross it; `linkage circuits` \
             lists them",
            input.name.text,
            places.join(", ")
        );
    }

    /// Says where outputs have kinks, and which columns are empty there, of those that are asked for or of all.
    pub fn say_kinks(&self, kinks: &[(f64, String)], asked: &[String]) {
        let is_asked = |name: &String| asked.is_empty() || asked.contains(name);
        let kinks: Vec<_> = kinks.iter().filter(|(_, name)| is_asked(name)).collect();
        let Some((first, _)) = kinks.first() else { return };
        let names: Vec<&str> = kinks.iter().filter(|(at, _)| at == first).map(|(_, name)| name.as_str()).collect();
        let (input, others) = (&self.machine.about.inputs[self.path.moving], kinks.len() - names.len());
        let more = if others > 0 { format!("; there are {others} more such cells") } else { String::new() };
        say!(
            "at {} = {} there is a kink, and no {}{more}",
            input.name.text,
            shown(*first, input.is_angle),
            names.join(", ")
        );
    }

    /// A gap that no row falls into: the motion is met again a turn later.
    fn say_gaps(&self) {
        let (Some(range), Some(period)) = (&self.range, self.period()) else { return };
        let ([first, last], [least, largest]) = (range.inputs(), self.sorted());
        if range.is_closed() {
            return;
        }
        let input = &self.machine.about.inputs[self.path.moving];
        let gaps =
            self.repeated(last).into_iter().filter(|end| *end > least && end + (first + period - last) < largest);
        for end in gaps.take(NAMED) {
            let gap = [end, end + (first + period - last)].map(|end| shown(end, input.is_angle));
            let [near, far] = if self.is_falling() { [&gap[1], &gap[0]] } else { [&gap[0], &gap[1]] };
            let unit = if input.is_angle { "deg" } else { "" };
            say!(
                "between {} = {near} and {far} there is no position: the motion does not get across; end with `--to {}{unit}`",
                input.name.text,
                near.trim_end_matches('°'),
            );
        }
    }
}

/// Says on standard error which columns are angles that are not followed where their formulas jump, of those that are asked for
/// or of all.
pub fn say_jumps(machine: &Machine, asked: &[String]) {
    let outputs = machine.about.outputs.iter().zip(&machine.about.output_angles);
    let differing = outputs.filter(|(_, angle)| angle.is_some_and(|angle| angle.jumps_differ));
    for (output, _) in differing.filter(|(output, _)| asked.is_empty() || asked.contains(&output.text)) {
        say!(
            "`{}` is a sum of angles with different factors, each of which jumps by a turn at 180°: its values are those of its \
             formula, with these jumps; `linkage certify` and `linkage report` have its range without them",
            output.text
        );
    }
}
