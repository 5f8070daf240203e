//! The methods for the double butterfly: its six angles are coupled, without closed form.

works!(DoubleButterfly, 6, newton 4);

use linkage_gallery::double_butterfly::*;
