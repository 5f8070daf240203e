//! Grid lines of an axis and their labels.

/// The grid step, 1, 2 or 5 times a power of ten, for about so many lines in a range.
pub fn nice([low, high]: [f64; 2], count: f64) -> f64 {
    let rough = (high - low) / count;
    let power = 10_f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
    *steps.iter().find(|step| **step >= rough).unwrap_or(&steps[3])
}

/// The multiples of a step in a range.
pub fn ticks([low, high]: [f64; 2], step: f64) -> impl Iterator<Item = f64> {
    let [first, last] = [(low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64];
    (first..=last).map(move |count| count as f64 * step)
}

/// The text of a number, with the digits of the step.
pub fn label(at: f64, step: f64) -> String {
    let digits = (-step.log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{at:.digits$}").replace('-', "−")
}
