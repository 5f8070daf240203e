use linkage::linkage;

linkage! {
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@thetta4 = l1@0;
        point B = l2@theta2;
    }
}

fn main() {
    let four_bar = FourBar::new(80.0, 20.0, 50.0, 70.0);
    let q = FourBarCoordinates { theta2: 0.3, theta3: 1.0, theta4: -1.0 };
    let solution = four_bar.solve(&q).unwrap();
    let pose = four_bar.pose_at(&solution.coordinates);
    println!("{}", four_bar.velocity_ratios(&pose).unwrap());
    println!("{}", four_bar.points(&pose).unwrap().b);
}
