"""Cameras, tours, views and pictures."""

import subprocess
import sys

import numpy as np
import pytest

import abut
from shapes import box


def two_boxes():
    pose = np.eye(4)
    pose[0, 3] = 0.75
    mesh = abut.Mesh(*box())
    parts = [abut.Part("tank", 0, type="IfcTank", colour=abut.Colour(255, 0, 0)), abut.Part("pipe", 0, pose, type="IfcPipe")]
    return abut.Scene([mesh], parts, file="two.glb")


def drawn(*arguments, **options):
    try:
        return abut.picture(*arguments, **{"width": 160, "height": 120, **options})
    except abut.Error as error:
        if error.code is abut.ErrorCode.unsupported:
            pytest.skip(str(error))
        raise


def test_camera():
    camera = abut.Camera((1, 2, 3), (0, 1, 0), width=200, height=100)
    assert camera.eye.tolist() == [1, 2, 3] and camera.width == 200
    ray = abut.ray_through(camera, 100, 50)  # the middle
    assert np.allclose(ray.direction, (0, 1, 0)) and ray.origin.tolist() == [1, 2, 3]
    clip = abut.clip_from_world(camera) @ np.array([1, 7, 3, 1])
    assert np.allclose(clip[:2], 0, atol=1e-5) and clip[3] == pytest.approx(5)
    assert abut.length_of_pixel(camera) == pytest.approx(2 * np.tan(camera.field_of_view / 2) / 100)
    seen = abut.look_at_box(abut.Box3((0, 0, 0), (1, 1, 1)), (0, 1, 0), (0, 0, 1))
    assert seen.eye[1] < 0 and np.allclose(seen.forward, (0, 1, 0))
    with pytest.raises(abut.Error):
        abut.clip_from_world(abut.Camera(forward=(0, 0, 0)))
    with pytest.raises(ValueError):
        abut.Camera((1, 2))


def test_tour(tmp_path):
    tour = abut.Tour([abut.TourPoint(0, (0, 0, 0), (0, 1, 0), name="door"), abut.TourPoint(2, (0, 4, 0), (0, 1, 0))])
    assert abut.duration(tour) == 2 and abut.camera_at(tour, 1).eye[1] == pytest.approx(2)
    abut.record(tour, 3, abut.Camera((1, 4, 0)), "end")
    assert len(tour.points) == 3 and tour.points[2].name == "end"
    abut.write_tour(tour, tmp_path / "tour.json")
    assert abut.read_tour(tmp_path / "tour.json") == tour
    with pytest.raises(abut.Error):
        abut.record(tour, 1, abut.Camera())
    with pytest.raises(abut.Error):
        abut.camera_at(abut.Tour(), 0)


def test_picture(tmp_path):
    pixels = drawn(two_boxes())
    assert pixels.shape == (120, 160, 3) and pixels.dtype == np.uint8
    assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 50
    abut.write_png(pixels, tmp_path / "two.png")
    assert (tmp_path / "two.png").read_bytes().startswith(b"\x89PNG")
    matplotlib = pytest.importorskip("matplotlib.image")
    assert (np.round(matplotlib.imread(tmp_path / "two.png")[..., :3] * 255) == pixels).all()


def test_what_a_picture_is_of():
    scene = two_boxes()
    views = [drawn(scene, aim) for aim in ("top", abut.NamedView.front, abut.Camera((0.5, -4, 0.5)), abut.PartAim("tank"),
                                           abut.PairAim(("two.glb", "two.glb"), ("tank", "pipe")))]
    assert all((a != b).any() for i, a in enumerate(views) for b in views[:i])
    clash = abut.find_clashes([scene]).clashes[0]
    assert (drawn(scene, clash) != views[0]).any()
    cut = drawn(scene, "front", sections=[abut.SectionPlane((0, 0, 1), 0.0)])
    assert (cut != views[1]).any()
    inner = drawn(scene, "front", section_box=abut.Box3((-1, -1, -1), (0.5, 2, 2)))
    assert (inner != views[1]).any()
    with pytest.raises(abut.Error) as caught:
        drawn(scene, abut.PartAim("missing"))
    assert caught.value.code is abut.ErrorCode.bad_argument
    with pytest.raises((TypeError, ValueError)):
        abut.picture(scene, "sideways")
    with pytest.raises(ValueError):
        abut.write_png(np.zeros((4, 4), np.uint8), "picture.png")
    with pytest.raises(TypeError):
        abut.write_png([1, 2, 3], "picture.png")


def test_a_store_and_its_view(tmp_path):
    abut.write_glb(two_boxes(), tmp_path / "two.glb")
    abut.import_models([tmp_path / "two.glb"], tmp_path / "two.abut")
    abut.build_levels(tmp_path / "two.abut")
    with abut.open_store(tmp_path / "two.abut") as store:
        colours = abut.part_colours(store, "type")
        assert len(colours) == 2 and colours[0] != colours[1]
        view = abut.View(store, background=False)
        camera = abut.look_at_box(view.bounds, (0, 1, 0), (0, 0, 1))
        view.frame(camera)
        view.wait()
        frame = view.frame(camera)
        assert frame.loaded and len(frame.draws) > 0 and view.statistics.triangles > 0
        assert len(view.parts) == 2 and view.index_of(int(view.parts[1])) == 1
        assert {view.part(i).id for i in range(2)} == {"tank", "pipe"}
        found = view.find_parts("tan")
        assert [view.part(int(i)).id for i in found.parts] == ["tank"] and found.next == 2
        view.set_hidden(0, True)
        view.set_occlusion(False)
        pixels = drawn(store, "iso")
        assert pixels.shape == (120, 160, 3)
    assert view.part(0).file.endswith("two.glb")  # the view keeps the file open


def test_chunks_have_the_geometry(tmp_path):
    abut.write_glb(two_boxes(), tmp_path / "two.glb")
    abut.import_models([tmp_path / "two.glb"], tmp_path / "two.abut")
    abut.build_levels(tmp_path / "two.abut")
    with abut.open_store(tmp_path / "two.abut") as store:
        view = abut.View(store, background=False)
        uploads = view.frame(abut.look_at_box(view.bounds, (0, 1, 0), (0, 0, 1))).uploads
    chunk = next(iter(uploads.values()))
    assert chunk.vertices.shape[1] == 3 and chunk.faces.max() < len(chunk.vertices) == len(chunk.parts)


def test_importing_needs_no_graphics():
    program = "import abut; print(abut.Camera().width)"
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                            env={"PYTHONPATH": ":".join(sys.path), "__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent", "PATH": "/usr/bin"})
    assert result.stdout == "1280\n", result.stderr
