// Lets a ball fall on a floor and bounce: the smallest loop of a simulator.
//
//     abut-falling-ball

#include <abut/world.h>

#include "program.h"

#include <cmath>

namespace {

int run(int, char**) {
    abut::World world;
    world.add(abut::Box3{{-5, -5, -1}, {5, 5, 0}}, {}, {.is_static = true}); // the floor
    abut::Pose pose{.translation = {0, 0, 2}};
    const abut::BodyId ball = world.add(abut::Sphere{{0, 0, 0}, 0.5}, pose);

    const double dt = 1.0 / 60;
    double speed = 0; // of the ball, upwards
    for (int step = 0; step < 240; ++step) {
        speed -= 9.81 * dt;
        pose.translation.z += speed * dt;
        world.move(ball, pose);
        for (const abut::BodyGap& contact : world.penetration()) {
            pose.translation.z -= contact.distance * contact.normal.z; // out of the floor
            speed = std::abs(speed) / 2;                               // it loses half of its speed
            world.move(ball, pose);
        }
    }
    std::printf("the ball rests at z = %.2f m\n", pose.translation.z);
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    return run_program("abut-falling-ball", run, argc, argv);
}
