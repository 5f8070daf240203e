//! Dead points of the input along a curve: zeros of its derivative by the parameter of a tube.

use linkage_runtime::{Certifiable, Column};

use super::certificate::Moved;
use super::error::CertifyErrorOf;
use super::jet::Measure;
use super::motion::unknowns_of;
use super::reason::{nearest_group, reason};
use super::system::{Dimensions, System};
use super::tube::Tube;
use crate::Interval;

/// The most divisions of a tube in halves: until its parts are as short as rounding errors.
const MOST_DIVISIONS: usize = 50;

/// Places where a part is divided; at one of them at least the derivative is not zero.
const CUTS: [f64; 4] = [0.5, 0.45, 0.55, 0.4];

/// A position at which the input turns back.
pub struct DeadPoint<M: Certifiable> {
    /// It contains the limit of the input.
    pub input: Interval,
    /// They contain the unknowns.
    pub unknowns: Column<Interval, M::U>,
    /// True at a largest input, false at a smallest one.
    pub is_largest: bool,
    /// The unknowns of the group that is singular.
    pub group: M::Name,
    q: Vec<Interval>,
}

/// The rate of the input over a tube.
struct InputRate<'a, M: Certifiable> {
    system: &'a System<M>,
    tube: &'a Tube,
}

impl<M: Certifiable> InputRate<'_, M> {
    /// The rate and its derivative.
    fn over(&self, c: Interval) -> Option<[Interval; 2]> {
        let jet = Measure::Rate(self.system.count()).jet(self.system, self.tube, c, Interval::ENTIRE)?;
        Some([jet.value, jet.first])
    }

    /// The sign of the rate at a point; zero if it is not certain.
    fn sign(&self, c: f64) -> f64 {
        self.over(c.into()).map_or(0.0, |[rate, _]| if rate.contains(0.0) { 0.0 } else { rate.middle().signum() })
    }

    /// The zeros between two points at which the signs are known, or zero at an end of the tube, where the next tube
    /// has them; `None` if they cannot be isolated.
    fn zeros(&self, [low, high]: [f64; 2], signs: [f64; 2], divisions: usize) -> Option<Vec<Interval>> {
        let c = Interval::new(low, high)?;
        if let Some([rate, slope]) = self.over(c) {
            if !rate.contains(0.0) {
                return Some(Vec::new());
            }
            if !slope.contains(0.0) {
                let [one, other] = signs;
                return Some(if one * other < 0.0 { vec![self.narrowed(c)] } else { Vec::new() });
            }
        }
        let divisions = divisions.checked_sub(1)?;
        let cuts = CUTS.map(|part| low + part * (high - low));
        let (cut, sign) = cuts.into_iter().map(|cut| (cut, self.sign(cut))).find(|&(_, sign)| sign != 0.0)?;
        let mut zeros = self.zeros([low, cut], [signs[0], sign], divisions)?;
        zeros.extend(self.zeros([cut, high], [sign, signs[1]], divisions)?);
        Some(zeros)
    }

    /// Newton's method with intervals for the one zero in a part, while it halves it.
    fn narrowed(&self, mut c: Interval) -> Interval {
        for _ in 0..MOST_DIVISIONS {
            let middle = Interval::from(c.middle());
            let (Some([_, slope]), Some([rate, _])) = (self.over(c), self.over(middle)) else { return c };
            match c.intersection(middle - rate / slope) {
                Some(next) if next.width() < 0.5 * c.width() => c = next,
                _ => return c,
            }
        }
        c
    }

    /// The dead point at a zero of the rate.
    fn dead_point(&self, c: Interval) -> Option<DeadPoint<M>> {
        let q = self.tube.part(self.system, Dimensions::All, c)?.q;
        let [rate, slope] = self.over(c)?;
        let middle = Interval::from(c.middle());
        let at = self.tube.part(self.system, Dimensions::All, middle)?.q;
        let input = q.last()?.intersection(*at.last()? + rate * (c - middle))?;
        let floats: Vec<f64> = q.iter().map(|x| x.middle()).collect();
        let group = nearest_group(self.system, &floats);
        Some(DeadPoint { input, unknowns: unknowns_of(self.system, &q), is_largest: slope.most() < 0.0, group, q })
    }

    fn all(&self) -> Option<Vec<DeadPoint<M>>> {
        let ends = [self.tube.range.least(), self.tube.range.most()];
        let zeros = self.zeros(ends, ends.map(|end| self.sign(end)), MOST_DIVISIONS)?;
        zeros.into_iter().map(|c| self.dead_point(c)).collect()
    }
}

/// The dead points of tubes in the order of the curve, each once.
pub(super) fn dead_points<M: Certifiable>(
    system: &System<M>,
    tubes: &[Tube],
) -> Result<Vec<DeadPoint<M>>, CertifyErrorOf<M>> {
    let mut all: Vec<DeadPoint<M>> = Vec::new();
    for tube in tubes.iter().filter(|tube| tube.expansion.parameter != system.count()) {
        let undecided = || reason(system, &tube.expansion.q, &tube.over(tube.range));
        let mut found = InputRate { system, tube }.all().ok_or_else(undecided)?;
        if tube.is_backward {
            found.reverse();
        }
        for point in found {
            // In the overlap of two tubes a dead point is found twice, near the start perhaps after full turns.
            let again = all.last().is_some_and(|last| intersect(&last.q, &point.q));
            let first = all.first().and_then(|first| Moved::into_tube(system, tube, &first.q));
            if !again && !first.is_some_and(|first| intersect(&first.q, &point.q)) {
                all.push(point);
            }
        }
    }
    Ok(all)
}

fn intersect(these: &[Interval], those: &[Interval]) -> bool {
    these.iter().zip(those).all(|(&this, &that)| this.intersection(that).is_some())
}
