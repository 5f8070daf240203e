use linkage::linkage;

linkage! {
    mechanism Angles {
        param crank = 40, rod = 120, bank = 45deg;
        input theta;
        unknown front, s_front, rear, s_rear;
        loop crank@theta + rod@front = s_front@bank;
        loop crank@theta + rod@rear = s_rear@(-bank);
        point Front = s_front@bank;
        point Rear = s_rear@(-bank);
    }

    mechanism Mirrored {
        param crank = 40, rod = 120, bank = 45deg;
        input theta;
        unknown front, s_front, rear, s_rear;
        loop crank@theta + rod@(-front) = s_front@bank;
        loop crank@theta = rod@(pi - rear) + s_rear@(-bank);
        point Front = s_front@bank;
        point Rear = s_rear@(-bank);
    }

    mechanism Joints {
        param crank = 40, rod = 120, bank = 45deg;
        input theta;
        unknown fx, fy, rx, ry, front, s_front, rear, s_rear;
        loop crank@theta + rod@front = (fx, fy);
        loop (fx, fy) = s_front@bank;
        loop crank@theta + rod@rear = (rx, ry);
        loop (rx, ry) = s_rear@(-bank);
        point Front = (fx, fy);
        point Rear = (rx, ry);
    }

    mechanism Distances {
        param crank = 40, rod = 120, bank = 45deg;
        input theta;
        unknown s_front, s_rear;
        equation norm(s_front@bank - crank@theta) = rod;
        equation norm(crank@theta - s_rear@(-bank))^2 = rod^2;
        point Front = s_front@bank;
        point Rear = s_rear@(-bank);
    }
}

#[test]
fn v_twin() {
    for degrees in 0..360 {
        let theta = f64::from(degrees).to_radians();
        assert_eq!(crate::three_ways::same!(theta; Angles, Mirrored, Joints, Distances), 4);
    }
}
