//! The double butterfly's methods: six angles that are found together have no closed form.

works!(DoubleButterfly, 6, newton 4);

include!("../../tests/mechanisms/double_butterfly.rs");
