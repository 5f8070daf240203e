use linkage::linkage;

linkage! {
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point C = l2@theta2 + l3@theta3;
        output height = sqrt(C);
    }
}

fn main() {
    let four_bar = FourBar::<f64>::default();
    let q = FourBarCoordinates { theta2: 0.3, theta3: 1.0, theta4: -1.0 };
    println!("{}", four_bar.outputs(&four_bar.pose_at(&q)).unwrap().height);
}
