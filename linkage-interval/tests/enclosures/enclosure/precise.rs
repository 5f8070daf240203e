//! Floats of 160 bits, 48 digits, with the functions of dashu.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use linkage_interval::Interval;

pub type Big = FBig<HalfEven, 2>;

/// A double, exactly; zero without its sign, which would choose a side of the cut of an angle.
pub fn big(value: f64) -> Big {
    Big::try_from(if value == 0.0 { 0.0 } else { value }).expect("a finite number").with_precision(160).value()
}

/// True if the number is between the bounds.
pub fn encloses(interval: Interval, number: &Big) -> bool {
    let (least, most) = (interval.least(), interval.most());
    (least.is_infinite() || big(least) <= *number) && (most.is_infinite() || *number <= big(most))
}

/// The number of doubles from one to another, upward.
pub fn doubles(from: f64, to: f64) -> i64 {
    let order = |x: f64| {
        let bits = x.abs().to_bits().cast_signed();
        if x < 0.0 { -bits } else { bits }
    };
    order(to).saturating_sub(order(from))
}
