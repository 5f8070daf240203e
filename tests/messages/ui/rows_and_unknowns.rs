use linkage::linkage;

linkage! {
    pub mechanism SixBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4, theta5;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@theta5;
    }
}

fn main() {
    let six_bar = SixBar::<f64>::default();
    println!("{:?}", six_bar.solve(&SixBarCoordinates { theta2: 0.0, theta3: 0.0, theta4: 0.0, theta5: 0.0 }));
}
