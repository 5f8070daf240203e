//! The methods for the four-bar.

works!(FourBar, 2, closed, products by_products);

use linkage_gallery::four_bar::*;

fn by_products(m: &FourBar, pose: &FourBarPose, right: &Unknowns<f64>) -> Unknowns<f64> {
    let columns = [methods::turned(m.l3, pose.theta3), methods::turned(m.l4, pose.theta4)];
    methods::dyad(columns[0], columns[1], [right[0], right[1]]).into()
}
