//! The slider-crank.

use linkage::linkage;

linkage! {
    /// Slider-crank with an offset.
    pub mechanism SliderCrank {
        param crank = 1, rod = 3, offset = 0.25;
        input theta;
        unknown phi, s;
        loop crank@theta + rod@phi = (s, offset);
        derive lanes;
    }
}
