//! The double butterfly's methods: six angles that are found together have no closed form.

works!(DoubleButterfly, DoubleButterflyCoordinates, DoubleButterflyPose, DoubleButterflyInputs, 6, newton 4);

include!("../../tests/mechanisms/double_butterfly.rs");
