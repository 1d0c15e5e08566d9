#!/usr/bin/env python3
"""Checks the trajectory of a robot arm: is it free, and how near does each link come to the cell?

    robot_trajectory.py [--waypoints N]

The arm has three links on revolute joints. Between two waypoints each link moves along a screw, so nothing is missed
between them, however few waypoints there are.
"""

import argparse

import numpy as np

import abut

LENGTHS = (0.5, 0.6, 0.4)  # metres


def box(lower, upper):
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
             [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    return abut.Model(np.asarray(lower) + corners * np.subtract(upper, lower), np.array(faces))


def turned(axis, angle):
    """The rotation about z (axis 0) or y (axis 1), as a matrix of shape (4, 4)."""
    c, s = np.cos(angle), np.sin(angle)
    matrix = np.eye(4)
    if axis == 0:
        matrix[:2, :2] = [[c, -s], [s, c]]
    else:
        matrix[:3:2, :3:2] = [[c, s], [-s, c]]
    return matrix


def link_poses(angles):
    """Forward kinematics: the poses of the links for the angles of the joints, shape (3, 4, 4)."""
    poses, frame = [], np.eye(4)
    for i, angle in enumerate(angles):
        frame = frame @ turned(0 if i == 0 else 1, angle)
        poses.append(frame)
        frame = frame.copy()
        frame[:3, 3] += frame[:3, 2] * LENGTHS[i]  # the next joint is at the end of the link
    return np.array(poses)


def trajectory(start, end, waypoints):
    """Poses of the links along straight lines in the angles, shape (waypoints, 3, 4, 4)."""
    along = np.linspace(0, 1, waypoints)[:, None]
    return np.array([link_poses(angles) for angles in (1 - along) * start + along * end])


def first_contact(links, cell, poses):
    """The waypoint before the first contact, the fraction of the motion that is free, and the link; else None."""
    rest = abut.Motion.fixed(abut.Pose())
    for step in range(len(poses) - 1):
        impacts = [abut.time_of_impact(link, abut.Motion.screw(poses[step, i], poses[step + 1, i]), cell, rest)
                   for i, link in enumerate(links)]
        if any(impacts):
            first = min(range(len(links)), key=lambda i: impacts[i].time)
            return step, impacts[first].time, first
    return None


def show(name, links, cell, poses):
    for i, link in enumerate(links):
        gaps = abut.distance(link, poses[:, i], cell, None)  # all waypoints in one call
        print(f"{name}, link {i + 1}: at least {gaps.distance.min():.3f} m away, at waypoint {gaps.distance.argmin()}")
    contact = first_contact(links, cell, poses)
    if contact is None:
        print(f"{name}: free, between the waypoints too")
    else:
        step, time, link = contact
        print(f"{name}: link {link + 1} meets the cell after {100 * time:.1f} % of motion {step}")


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--waypoints", type=int, default=9)
    options = arguments.parse_args()
    links = [box((-0.05, -0.05, 0), (0.05, 0.05, length)) for length in LENGTHS]
    cell = box((0.7, -0.03, 0), (0.9, 0.03, 0.9))  # a post beside the robot
    low, high = np.radians([(-60, 50, 60), (60, 50, 60)])
    show("around the base", links, cell, trajectory(low, high, options.waypoints))
    folded_low, folded_high = np.radians([(-60, -50, -60), (60, -50, -60)])
    show("folded back", links, cell, trajectory(folded_low, folded_high, options.waypoints))


if __name__ == "__main__":
    main()
