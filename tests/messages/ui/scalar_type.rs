//! A driver called like the scalar of the emitted code.

use linkage::linkage;

linkage! {
    mechanism Chosen {
        param r = 1, l = 3;
        coordinate phi1, phi2, x;
        loop r@phi1 + l@phi2 = x@0;
        drive T by phi1;
        drive Engine by x;
    }
}

fn main() {}
