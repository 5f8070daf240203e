//! The double butterfly's methods: six angles that are found together have no closed form.

works!(DoubleButterfly, 6, newton 4);

use linkage_gallery::double_butterfly::*;
