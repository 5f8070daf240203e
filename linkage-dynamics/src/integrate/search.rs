//! The search for the first events of a step.

use nalgebra::ComplexField;

use super::bounds::Discs;
use super::event::{EventSign, EventSigns};
use super::passage::{Course, Next, may_pass};
use super::sampled::{FunctionSample, Sample, SampledStep};
use super::samples::Samples;
use super::system::{ErrorOf, StateOf, System};
use linkage_runtime::jacobian::first_not_positive;
use linkage_runtime::{Build, Column, D, Dim, real};

/// The largest number of equal parts of a step at whose ends guards are sampled.
const MAX_PARTS: usize = 64;

/// The most samples between two others in the search for passages of guards with known rates. A graze takes about ten,
/// each extremum more another six; where rounding errors hide the course, all are used.
const MAX_SAMPLES: u32 = 64;

/// The result of a search in a step.
pub(super) enum Found<S: System> {
    /// No event.
    Nothing,
    /// Possibly an event, found on the cubic, which is not accurate enough to decide.
    Perhaps,
    /// The first events.
    Hit(Hit<S>),
    /// A guard changes too much between samples for its events to be found.
    TooCoarse,
}

/// The first events in a step: there may be several at one time.
pub(super) struct Hit<S: System> {
    /// The fraction of the step.
    pub(super) at: f64,
    pub(super) t: S::Scalar,
    pub(super) state: StateOf<S>,
}

impl<K: Dim, C: Dim> EventSigns<K, C> {
    /// Finds the first events of the step after the fraction `from`, sampling at the ends of `parts` equal parts.
    /// Guards that are not close to a parabola between samples are sampled more often.
    ///
    /// If a function approaches zero at one sample and leaves it at the next, its extremum between them is located, so
    /// that two passages through zero are not missed. The cubic, which interpolates only states and rates at the ends
    /// of the step, costs no evaluation, but it yields no events, only [`Found::Perhaps`].
    pub(super) fn search<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut SampledStep<'_, S>,
        is_cubic: bool,
        (from, parts): (f64, usize),
    ) -> Result<Found<S>, ErrorOf<S>> {
        // Guards with known rates are examined at the ends of four parts.
        let (signs, mut parts) = (*self, if self.guards.dim().count() > 0 { parts.next_multiple_of(4) } else { parts });
        loop {
            let found =
                if is_cubic { self.search_cubic(course, parts)? } else { self.search_dense(course, (from, parts))? };
            match found {
                Found::TooCoarse if parts < MAX_PARTS => {
                    *self = signs;
                    parts *= 2;
                }
                found => return Ok(found),
            }
        }
    }

    /// Searches the cubic for a possible event: a function that passes zero, or approaches it and has an extremum.
    fn search_cubic<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut SampledStep<'_, S>,
        parts: usize,
    ) -> Result<Found<S>, ErrorOf<S>> {
        let mut before = course.sample(0.0)?;
        let mut samples = Samples::new(self.grow(&before));
        samples.push(before.unknown());
        let mut older = None;
        let start = self.guards;
        let mut quarters = [before.guards; 5];
        for part in 1..=parts {
            let here = course.sample(part as f64 / parts as f64)?;
            samples.push(here.unknown());
            if samples.are_too_coarse() {
                return Ok(Found::TooCoarse);
            }
            if self.any_event(&here) || self.any_extremum(&before, &here) {
                return Ok(Found::Perhaps);
            }
            // A function without a known rate has an extremum if a value is nearer to zero than both neighbours; at the
            // ends of the step one neighbour is a sample close by.
            let has_extremum = match &older {
                Some(older) => self.any_unknown([older, &before, &here], |function, [older, before, here]| {
                    function.approaches_zero(older, before) && !function.approaches_zero(before, here)
                }),
                None if self.any_unknown([&before, &here], |function, [before, here]| {
                    !function.approaches_zero(before, here)
                }) =>
                {
                    let nearby = course.nearby_sample(0.0)?;
                    self.any_unknown([&before, &nearby, &here], |function, [before, nearby, here]| {
                        function.approaches_zero(before, nearby) && !function.approaches_zero(before, here)
                    })
                }
                None => false,
            };
            if has_extremum {
                return Ok(Found::Perhaps);
            }
            if part == parts
                && self.any_unknown([&before, &here], |function, [before, here]| function.approaches_zero(before, here))
            {
                let nearby = course.nearby_sample(1.0)?;
                if self.any_unknown([&nearby, &here], |function, [nearby, here]| function.approaches_zero(here, nearby))
                {
                    return Ok(Found::Perhaps);
                }
            }
            self.update(&here);
            if 4 * part % parts == 0 {
                quarters[4 * part / parts] = here.guards;
            }
            (older, before) = (Some(before), here);
        }
        let bounds = [0.0, 0.25, 0.5, 0.75].map(|from| {
            let part = [from, from + 0.25];
            course.discs(part, &Discs::none(self.guards.dim())).errors(part, &course.tolerated)
        });
        let passes = |place: usize| {
            let of = quarters.map(|sample| sample[place]);
            let bounds = bounds.map(|bound| bound[place].unwrap_or(0.0));
            of.iter().all(|sample| start[place].has_known_course(sample))
                && may_pass(of.map(|sample| [sample.value - of[0].value.min(0.0), sample.rate]), bounds)
        };
        Ok(if (0..self.guards.dim().count()).any(passes) { Found::Perhaps } else { Found::Nothing })
    }

    fn any_extremum(&self, before: &Sample<K, C>, here: &Sample<K, C>) -> bool {
        self.each()
            .zip(before.each().zip(here.each()))
            .any(|(function, (before, here))| function.has_extremum(before, here))
    }

    /// Returns true if `is_so` holds for a function without a known rate.
    fn any_unknown<const P: usize>(
        &self,
        samples: [&Sample<K, C>; P],
        is_so: impl Fn(&EventSign, [&FunctionSample; P]) -> bool,
    ) -> bool {
        let events = (0..self.events.dim().count())
            .any(|i| self.events[i].sign != 0 && is_so(&self.events[i], D::map(samples, |sample| &sample.events[i])));
        let unknown = |i: usize| samples.iter().all(|sample| !sample.guards[i].is_known);
        let guards = |i: usize| is_so(&self.guards[i], D::map(samples, |sample| &sample.guards[i]));
        events || (0..self.guards.dim().count()).any(|i| self.guards[i].sign != 0 && unknown(i) && guards(i))
    }

    /// Searches the dense output for the first events.
    fn search_dense<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut SampledStep<'_, S>,
        (from, parts): (f64, usize),
    ) -> Result<Found<S>, ErrorOf<S>> {
        let mut before = course.sample_with_rates(from)?;
        let mut samples = Samples::new(self.grow(&before));
        if from == 0.0 {
            samples.push(before.unknown());
        }
        // The fractions of the step around the first event.
        let mut happened = None;
        let mut is_resolved = true;
        for part in 1..=parts {
            let at = part as f64 / parts as f64;
            if at <= from {
                continue;
            }
            let here = course.sample_with_rates(at)?;
            samples.push(here.unknown());
            if samples.are_too_coarse() {
                return Ok(Found::TooCoarse);
            }
            if happened.is_none() {
                happened = self.bracket(course, before, &here, &mut is_resolved)?;
            }
            // After an event of the user within the step it cannot be repeated.
            if !is_resolved && from == 0.0 {
                return Ok(Found::TooCoarse);
            }
            if happened.is_some() && (self.guards.dim().count() == 0 || samples.are_enough()) {
                break;
            }
            before = here;
        }
        happened.map_or(Ok(Found::Nothing), |between| self.locate(course, between).map(Found::Hit))
    }

    /// Returns the fractions of the step before and after the first event between two samples.
    fn bracket<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut SampledStep<'_, S>,
        before: Sample<K, C>,
        here: &Sample<K, C>,
        is_resolved: &mut bool,
    ) -> Result<Option<(f64, f64)>, ErrorOf<S>> {
        let mut before = before;
        let unknown = &(self.guards.dim().repeat(f64::INFINITY), Discs::none(self.guards.dim()));
        // Each of the other functions has at most one extremum here.
        for _ in 0..self.each().count() {
            let Some(turn) = self.first_beyond_extremum(course, &before, here)? else { break };
            let found = self.refine(course, (&before, &turn), unknown, (&mut { MAX_SAMPLES }, is_resolved))?;
            if found.is_some() {
                return Ok(found);
            }
            before = turn;
        }
        self.refine(course, (&before, here), unknown, (&mut { MAX_SAMPLES }, is_resolved))
    }

    /// Returns the fractions of the step around the first event between two samples, and updates the signs up to there.
    /// Samples are added until the guards with known rates have no passage between neighbours, or one. `errors` are
    /// those of the cubics through the two samples, as estimated, and `discs` bound them; `left` is the number of samples that may be added, and `is_resolved`
    /// becomes false if these are not enough for a guard with a bound.
    fn refine<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut SampledStep<'_, S>,
        (before, here): (&Sample<K, C>, &Sample<K, C>),
        (errors, discs): &(Column<f64, C>, Discs<C>),
        (left, is_resolved): (&mut u32, &mut bool),
    ) -> Result<Option<(f64, f64)>, ErrorOf<S>> {
        let width = here.at - before.at;
        // Near an extremum an error of the time of sqrt(resolution) changes the value by its rounding error only.
        let near = ComplexField::sqrt(course.resolution) / width;
        let by_part = |sample: &FunctionSample, base: f64| [sample.value - base, sample.rate * width];
        let discs = course.discs([before.at, here.at], discs);
        let bounds = discs.errors([before.at, here.at], &course.tolerated);
        let courses: Column<Option<Course>, C> = self.guards.dim().column(|place| {
            let (start, end) = (&before.guards[place], &here.guards[place]);
            let is_known = [start, end].iter().all(|sample| self.guards[place].has_known_course(sample));
            let base = start.value.min(0.0);
            is_known.then(|| {
                let course = Course::new(by_part(start, base), by_part(end, base), errors[place]);
                bounds[place].map_or(course, |bound| course.with_bound(bound))
            })
        });
        let next = courses.iter().enumerate().find_map(|(place, of)| {
            match of.as_ref()?.next(self.guards[place].passed(&here.guards[place]), near) {
                Next::Sample(x) => Some(x),
                Next::Done => None,
            }
        });
        if let Some(x) = next.filter(|_| *left > 0) {
            let at = before.at + x * width;
            if at > before.at && at < here.at {
                *left -= 1;
                let between = course.sample(at)?;
                let errors = courses.dim().column(|place| match &courses[place] {
                    Some(of) if x == 0.5 => {
                        let base = before.guards[place].value.min(0.0);
                        of.error_of_half(by_part(&between.guards[place], base))
                    }
                    _ => errors[place],
                });
                let known = &(errors, discs);
                let found = self.refine(course, (before, &between), known, (left, is_resolved))?;
                return match found {
                    Some(_) => Ok(found),
                    None => self.refine(course, (&between, here), known, (left, is_resolved)),
                };
            }
        } else if next.is_some() && bounds.iter().any(|bound| bound.is_some()) {
            *is_resolved = false;
        }
        if self.any_event(here) {
            return Ok(Some((before.at, here.at)));
        }
        self.update(here);
        Ok(None)
    }

    /// Returns the earliest sample at which a function that approaches zero and leaves it between two samples is beyond
    /// zero.
    fn first_beyond_extremum<S: System<Events = K, Guards = C>>(
        &self,
        course: &mut SampledStep<'_, S>,
        before: &Sample<K, C>,
        here: &Sample<K, C>,
    ) -> Result<Option<Sample<K, C>>, ErrorOf<S>> {
        let mut first: Option<Sample<K, C>> = None;
        for (place, (function, (start, end))) in self.each().zip(before.each().zip(here.each())).enumerate() {
            if !function.has_extremum(start, end) {
                continue;
            }
            let mut passed = None;
            // The extremum is where the rate away from zero is no longer negative; if it is zero at the start, where it
            // becomes positive.
            let still = if function.rate_away(start) == 0.0 { f64::MIN_POSITIVE } else { 0.0 };
            // Near an extremum an error of the time of sqrt(resolution) changes the value by its rounding error only.
            let enough = ComplexField::sqrt(course.resolution);
            first_not_positive::<_, ErrorOf<S>>(
                [before.at, here.at],
                [still - function.rate_away(start), -function.rate_away(end)],
                enough,
                |at| {
                    let sample = course.sample_with_rates(at)?;
                    let Some(own) = sample.each().nth(place) else { return Ok(None) };
                    if function.passed(own) {
                        passed = Some(sample);
                        return Ok(None);
                    }
                    Ok(Some(still - function.rate_away(own)))
                },
            )?;
            first = match (first, passed) {
                (Some(first), Some(passed)) if passed.at < first.at => Some(passed),
                (None, passed) => passed,
                (first, _) => first,
            };
        }
        Ok(first)
    }

    /// Locates the first events between two fractions of the step.
    fn locate<S: System<Events = K, Guards = C>>(
        &mut self,
        course: &mut SampledStep<'_, S>,
        (start, end): (f64, f64),
    ) -> Result<Hit<S>, ErrorOf<S>> {
        let ends = [self.least_distance(&course.sample(start)?), self.least_distance(&course.sample(end)?)];
        let resolution = course.resolution;
        let at = first_not_positive::<_, ErrorOf<S>>([start, end], ends, resolution, |at| {
            Ok(Some(self.least_distance(&course.sample(at)?)))
        })?;
        let there = course.sample(at)?;
        for (function, sample) in self.each_mut().zip(there.each()) {
            function.is_pending = function.passed(sample) && function.is_event();
            function.residual = if function.is_pending { sample.value.abs() } else { -1.0 };
        }
        self.update(&there);
        let step = course.step;
        Ok(Hit { at, t: step.time(at), state: step.at_fraction(real(at)) })
    }

    /// The least distance before a passage that is an event: positive before the first event, then zero or negative.
    fn least_distance(&self, sample: &Sample<K, C>) -> f64 {
        self.each()
            .zip(sample.each())
            .filter(|(function, _)| (function.sign != 0 || function.is_guard()) && function.is_event())
            .fold(f64::INFINITY, |least, (function, sample)| least.min(function.distance_before(sample)))
    }
}
