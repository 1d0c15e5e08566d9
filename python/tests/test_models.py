import pickle
import types

import numpy as np
import pytest

import abut
from shapes import box, matrix, sphere


@pytest.mark.parametrize("vertex_type", [np.float32, np.float64, ">f8", np.int64])
@pytest.mark.parametrize("face_type", [np.int32, np.int64, np.uint32, np.uint64, np.int16, ">i4"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_arrays_of_any_kind(vertex_type, face_type, order):
    vertices, faces = box((2, 4, 6))
    model = abut.Model(np.array(vertices, vertex_type, order=order), np.array(faces, face_type, order=order))
    assert np.array_equal(model.vertices, vertices)
    assert np.array_equal(model.faces, faces)
    assert model.vertices.dtype == np.float64 and model.faces.dtype == np.uint32


def test_strided_arrays_and_lists():
    vertices, faces = sphere(6)
    wide = np.zeros((2 * len(vertices), 5))
    wide[::2, 1:4] = vertices
    model = abut.Model(wide[::2, 1:4], faces[::-1])
    assert np.array_equal(model.vertices, vertices) and np.array_equal(model.faces, faces[::-1])
    assert np.array_equal(abut.Model(vertices.tolist(), faces.tolist()).faces, faces)


def test_arrays_are_copied_and_views_are_read_only():
    vertices, faces = box()
    model = abut.Model(vertices, faces)
    vertices[:] = 7
    assert model.vertices.max() == 0.5
    with pytest.raises(ValueError):
        model.vertices[0, 0] = 1
    view = model.vertices
    del model
    assert view.max() == 0.5  # it keeps the model


def test_objects_of_other_libraries():
    vertices, faces = box()
    trimesh = types.SimpleNamespace(vertices=vertices, faces=faces)
    meshio = types.SimpleNamespace(points=vertices, cells_dict={"triangle": faces[:4], "line": np.zeros((1, 2), int)})
    assert len(abut.Model(trimesh).faces) == 12
    assert len(abut.Model(meshio).faces) == 4
    quads = types.SimpleNamespace(points=vertices, cells_dict={"quad": np.array([[0, 1, 3, 2]])})
    assert np.array_equal(abut.Model(quads).faces, [[0, 1, 3], [0, 3, 2]])


def test_path(tmp_path):
    path = tmp_path / "box.ply"
    abut.write_frame(abut.Mesh(*box()), path)
    assert len(abut.Model(path).faces) == 12
    assert len(abut.Model(str(path)).faces) == 12
    with pytest.raises(abut.Error) as error:
        abut.Model(tmp_path / "none.ply")
    assert error.value.code == abut.ErrorCode.file_not_found
    assert error.value.file == str(tmp_path / "none.ply")
    assert str(error.value).startswith(error.value.file)


@pytest.mark.parametrize("bad", [-1, 8, 2**40])
def test_index_out_of_range(bad):
    vertices, faces = box()
    faces[3, 1] = bad
    with pytest.raises(abut.Error, match="triangle 3") as error:
        abut.Model(vertices, faces)
    assert error.value.code == abut.ErrorCode.bad_mesh


def test_wrong_arguments():
    vertices, faces = box()
    with pytest.raises(abut.Error) as error:
        abut.Model(vertices * np.nan, faces)
    assert error.value.code is abut.ErrorCode.bad_mesh
    for wrong in (lambda: abut.Model(vertices[:, :2], faces), lambda: abut.Model(vertices, faces[:, :2])):
        with pytest.raises(ValueError):
            wrong()
    for wrong in (lambda: abut.Model(vertices, faces.astype(float)), lambda: abut.Model(3), lambda: abut.Model(None)):
        with pytest.raises(TypeError):
            wrong()


def test_empty_model():
    empty = abut.Model(np.zeros((0, 3)), np.zeros((0, 3), int))
    gap = abut.distance(empty, None, abut.Model(*box()), None)
    assert gap.distance == np.inf and gap.status == abut.Status.bound_only


def test_pickle():
    model = pickle.loads(pickle.dumps(abut.Model(*sphere(5))))
    assert np.array_equal(model.vertices, sphere(5)[0])
    pose = abut.Pose((1, 2, 3), (1, 0, 1, 0))
    assert pickle.loads(pickle.dumps(pose)) == pose


def test_inspect_and_volumes():
    report = abut.inspect(abut.Mesh(*box()))
    assert report.closed and report.triangles == 12 and "closed=True" in repr(report)
    assert np.array_equal(report.bounds.upper, [0.5, 0.5, 0.5])
    for volume in abut.Volume:
        a = abut.Model(*sphere(6), volume=volume)
        gap = abut.distance(a, None, abut.Model(*sphere(6), volume=volume.name), matrix((3, 0, 0)))
        assert gap.distance == pytest.approx(1)
        assert gap.counters.volume is volume
    a, b = abut.Model(*sphere(6), volume="rss"), abut.Model(*sphere(6), volume="obb")
    for other, common in ((abut.Model(*sphere(6), volume="lss"), abut.Volume.ssv), (b, abut.Volume.automatic), (a, abut.Volume.rss)):
        gap = abut.distance(a, None, other, matrix((3, 0, 0)))
        assert gap.counters.volume is common and gap.distance == pytest.approx(1)
    assert abut.common_volume("rss", abut.Volume.pss) is abut.Volume.ssv
    assert abut.common_volume("rss", "rss") is abut.Volume.rss and abut.common_volume("rss", "kdop14") is abut.Volume.automatic
    with pytest.raises(ValueError, match="'box' is no Volume"):
        abut.common_volume("rss", "box")


def test_poses_of_every_kind():
    model = abut.Model(*box())
    q = np.array([0.5, 0.5, 0.5, 0.5])
    expected = abut.distance(model, None, model, matrix((3, 0.1, 0.2), q))
    for pose in [matrix((3, 0.1, 0.2), q).astype(np.float32).astype(float), np.asfortranarray(matrix((3, 0.1, 0.2), q)),
                 matrix((3, 0.1, 0.2), q).tolist(), ((3, 0.1, 0.2), 2 * q), abut.Pose((3, 0.1, 0.2), q)]:
        assert abut.distance(model, None, model, pose).distance == pytest.approx(expected.distance, abs=1e-6)
    bad = np.eye(4)
    bad[3, 0] = 1
    for wrong in (bad, np.eye(3), np.zeros((2, 3, 4)), ((0, 0, 0), (1, 0, 0))):
        with pytest.raises(ValueError):
            abut.distance(model, None, model, wrong)
    for wrong in ("pose", object(), 1j * np.eye(4)):
        with pytest.raises((TypeError, ValueError)):
            abut.distance(model, None, model, wrong)
    with pytest.raises(abut.Error) as error:
        abut.distance(model, None, model, ((0, 0, 0), (0, 0, 0, 0)))
    assert error.value.code is abut.ErrorCode.bad_argument
    with pytest.raises(ValueError, match="rotation"):
        abut.Pose.from_matrix(np.diag((2, 2, 2, 1)))
    assert np.allclose(abut.Pose.from_matrix(matrix((1, 2, 3), q)).matrix(), matrix((1, 2, 3), q))


def test_many_poses_from_arrays_of_any_layout():
    model = abut.Model(*box())
    poses = np.array([matrix((3 + i, 0.1, 0.2), (0.5, 0.5, 0.5, 0.5)) for i in range(6)])
    expected = [abut.distance(model, None, model, pose).distance for pose in poses]
    wide = np.zeros((12, 4, 8))
    wide[::2, :, ::2] = poses
    for same in (poses, np.asfortranarray(poses), wide[::2, :, ::2], poses.astype(">f8"), poses[::-1].copy()[::-1], poses.tolist()):
        assert abut.distance(model, None, model, same).distance.tolist() == expected
        assert abut.distance(model, same, model, poses[:1].repeat(6, axis=0)).distance[0] == abut.distance(model, poses[0], model, poses[0]).distance
    assert [depth.depth for depth in abut.penetration(model, poses, model, poses)] == [abut.penetration(model, p, model, p).depth for p in poses]
    convex = abut.Convex(*box())
    assert abut.distance(convex, poses, convex, None).distance.tolist() == [abut.distance(convex, p, convex, None).distance for p in poses]
    assert len(abut.distance(model, None, model, poses[:0])) == 0
    bad = poses.copy()
    bad[5, 3, 0] = 1
    for a, b in ((bad, None), (None, bad), (bad, poses[0])):
        with pytest.raises(ValueError, match="last row"):
            abut.distance(model, a, model, b)
    with pytest.raises(ValueError):
        abut.distance(model, poses, model, poses[:5])


def test_pickles():
    model = abut.Model(*sphere(6))
    for value in (model, abut.Pose((1, 2, 3)), abut.distance, abut.Status.exact, abut.Error):
        again = pickle.loads(pickle.dumps(value))
        assert type(again) is type(value) and (value is model or again == value)
    assert np.array_equal(pickle.loads(pickle.dumps(model)).faces, model.faces)
    assert abut.Model.__module__ == "abut" and abut.distance.__module__ == "abut"


def test_poses_are_multiplied(rng):
    a, b = (abut.Pose(rng.normal(size=3), rng.normal(size=4)) for _ in range(2))
    assert np.allclose((a * b).matrix(), a.matrix() @ b.matrix(), atol=1e-14)
    assert np.isclose(np.linalg.norm((a * b).rotation), 1)
    assert np.allclose((a.inverse() * a).matrix(), np.eye(4), atol=1e-14)
    points = rng.normal(size=(5, 3))
    assert np.allclose(a.apply(points), points @ a.matrix()[:3, :3].T + a.translation, atol=1e-14)
    assert np.allclose(a.rotate(points), points @ a.matrix()[:3, :3].T, atol=1e-14)
    assert a.apply(points[0]).shape == (3,) and np.array_equal(a.apply(points[0]), a.apply(points)[0])
    with pytest.raises(TypeError):
        a * 2
    with pytest.raises(abut.Error, match="quaternion of zero length"):
        abut.Pose((0, 0, 0), (0, 0, 0, 0)).inverse()
