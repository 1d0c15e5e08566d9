"""Cameras, tours, views and pictures."""

import os
import subprocess
import sys
import threading

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
        assert abut.part_colours([two_boxes()], "type") == colours
        with pytest.raises(abut.Error):
            abut.part_colours([two_boxes()], "clash")
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


def graphics(make):
    """What `make` returns; the test is skipped where there is no OpenGL."""
    try:
        return make()
    except abut.Error as error:
        if error.code is abut.ErrorCode.unsupported:
            pytest.skip(str(error))
        raise


def test_several_pictures_of_one_model():
    scene = two_boxes()
    first, second = (graphics(lambda: abut.PictureMaker(scene)) for _ in range(2))
    wanted = drawn(scene, "front")
    assert (first.make("front", width=160, height=120) == wanted).all()
    del second  # its objects are freed in its own context
    assert (first.make("front", width=160, height=120) == wanted).all()
    assert (first.make("top", width=160, height=120) != wanted).any()
    with pytest.raises(abut.Error):
        first.make(abut.PartAim("missing"))
    with pytest.raises(abut.Error):
        first.make(width=0)


def test_two_sides_and_colours_by_distance():
    scene = two_boxes()
    camera = abut.look_at_box(abut.Box3((0, 0, 0), (2, 1, 1)), (0, 1, -0.5), (0, 0, 1))
    tank, pipe = abut.NamedPart("two.glb", "tank"), abut.NamedPart("two.glb", "pipe")
    both = drawn(scene, abut.SidesAim(camera, [[tank], [pipe]]), ground=False)
    ghost = drawn(scene, abut.SidesAim(camera, [[tank], []], [pipe]), ground=False)
    alone = drawn(scene, abut.SidesAim(camera, [[tank], []]), ground=False)
    assert (both != ghost).any() and (ghost != alone).any()
    with pytest.raises(abut.Error):
        drawn(scene, abut.SidesAim(camera, [[abut.NamedPart("two.glb", "missing")], []]))
    plain = drawn(scene, camera)
    near = drawn(scene, camera, distances=abut.PartDistances("tank", 0.1))
    assert (plain != near).any()
    with pytest.raises(abut.Error):
        drawn(scene, camera, distances=abut.PartDistances("tank", float("nan")))


def test_png_in_memory(tmp_path):
    pixels = np.arange(4 * 6 * 3, dtype=np.uint8).reshape(4, 6, 3)
    abut.write_png(pixels, tmp_path / "a.png")
    assert abut.png_bytes(pixels) == (tmp_path / "a.png").read_bytes()
    assert abut.png_bytes(np.asfortranarray(pixels)) == abut.png_bytes(pixels)
    with pytest.raises(abut.Error):
        abut.png_bytes(pixels[:0])
    with pytest.raises(ValueError):
        abut.png_bytes(pixels.astype(float))


def store_of(folder):
    abut.write_glb(two_boxes(), folder / "two.glb")
    abut.import_models([folder / "two.glb"], folder / "two.abut")
    abut.build_levels(folder / "two.abut")
    return abut.open_store(folder / "two.abut")


def test_legend_of_colours(tmp_path):
    with store_of(tmp_path) as store:
        view = abut.View(store, background=False)
        colouring = abut.part_colouring(store, "type")
        parts = [view.part(i) for i in range(2)]
        assert colouring.groups.dtype == np.uint32 and {row.word for row in colouring.legend} == {"IfcTank", "IfcPipe"}
        for part, group, colour in zip(parts, colouring.groups, colouring.colours):
            assert colouring.legend[group].word == part.type and colouring.legend[group].colour == colour
        assert abut.part_colours(parts, "type") == colouring.colours == abut.part_colours(store, "type")
        assert abut.part_colouring(store, "material").legend == []
        assert abut.part_colours([], "type") == []
    with pytest.raises(ValueError):
        abut.part_colouring(store)


def test_renderer(tmp_path):
    with store_of(tmp_path) as store:
        view = abut.View(store, background=False)
    camera = abut.look_at_box(view.bounds, (0, 1, 0), (0, 0, 1), abut.Camera(width=80, height=60))
    renderer, other = (graphics(lambda: abut.Renderer(len(view.parts), view.origin)) for _ in range(2))
    frame = view.frame(camera)
    pixels = renderer.picture(frame, camera)
    assert pixels.shape == (60, 80, 3) and pixels.dtype == np.uint8
    assert renderer.statistics.triangles == 24 and renderer.statistics.chunks == len(frame.uploads)
    empty = other.picture(abut.View(store_of_nothing(tmp_path), background=False).frame(camera), camera)
    assert (empty != pixels).any()  # contexts do not mix
    del other
    drawn_part = renderer.part_at(40, 30)
    assert drawn_part in (0, 1) and renderer.part_at(0, 0) is None and renderer.part_at(80, 0) is None
    samples = renderer.visible_samples([0, 1, 7])
    assert samples.dtype == np.uint64 and samples[:2].all() and samples[2] == 0
    again = view.frame(camera)  # the chunks are there already
    assert len(again.uploads) == 0 and (renderer.picture(again, camera) == pixels).all()
    renderer.begin(camera)
    renderer.add(again)
    assert (renderer.end_picture() == pixels).all()
    hidden = abut.PartState(hidden=True)
    for part in (0, 1):
        renderer.set_state(part, hidden)
    assert renderer.state(1) == hidden and (renderer.picture(again, camera) == empty).all()
    renderer.set_state(0, abut.PartState(ghosted=True))
    assert renderer.has_ghosts and (renderer.picture(again, camera) != empty).any()


def store_of_nothing(folder):
    abut.write_glb(abut.Scene([abut.Mesh([[900, 900, 900], [901, 900, 900], [900, 901, 900]], [[0, 1, 2]])], [abut.Part("far", 0)]),
                   folder / "far.glb")
    abut.import_models([folder / "far.glb"], folder / "far.abut")
    abut.build_levels(folder / "far.abut")
    return abut.open_store(folder / "far.abut")


def test_renderer_draws_what_is_added(tmp_path):
    with store_of_nothing(tmp_path) as store:
        view = abut.View(store, background=False)
    camera = abut.Camera((0, -4, 0), width=80, height=60)
    renderer = graphics(lambda: abut.Renderer(len(view.parts), view.origin))
    frame = view.frame(camera)
    empty = renderer.picture(frame, camera)
    number = renderer.add_part(abut.Mesh(*box()), None, abut.PartState(abut.Colour(255, 0, 0)))
    assert (renderer.picture(frame, camera) != empty).any() and renderer.part_at(45, 25) == number
    near = abut.RenderStyle(distances=abut.distances_from(number + 1, abut.Model(*box()), None, 2.0, grid=1))
    assert (renderer.picture(frame, camera, near) != renderer.picture(frame, camera)).any()
    renderer.move_part(number, ((50, 0, 0), (1, 0, 0, 0)))
    assert (renderer.picture(frame, camera) == empty).all()
    assert (renderer.picture(frame, camera, marks=[abut.Mark((0, 0, 0), (1, 0, 0), width=4)]) != empty).any()
    style = abut.RenderStyle(samples=2, edges=False, ambient_occlusion=False, background_low=abut.Colour(0, 0, 0),
                             background_high=abut.Colour(0, 0, 0), ground=abut.Ground((0, 0, -1), 50), leave_out_backs=True)
    assert (renderer.picture(frame, camera, style) != empty).any()
    quick = abut.RenderStyle(ambient_occlusion=False, quick=True)
    assert quick.quick and (renderer.picture(frame, camera, quick) != empty).any()
    renderer.remove_part(number)
    for use in (lambda: renderer.move_part(number, None), lambda: renderer.remove_part(number), lambda: renderer.set_state(10**6, abut.PartState()),
                lambda: renderer.picture(frame, abut.Camera(forward=(0, 0, 0))), lambda: renderer.picture(frame, camera, abut.RenderStyle(samples=3)),
                lambda: renderer.picture(frame, camera, abut.RenderStyle(up=(0, 0, float("nan"))))):
        with pytest.raises(abut.Error):
            use()
    with pytest.raises(abut.Error):  # larger than any buffer
        renderer.begin(abut.Camera(width=1 << 20, height=8))
    assert renderer.part_at(1, 1) is None
    for use in (lambda: renderer.add(frame), renderer.end_picture):
        with pytest.raises(abut.Error):  # nothing was begun
            use()
    with pytest.raises(TypeError):
        abut.Renderer(-1)


def test_a_renderer_belongs_to_its_thread():
    renderer, maker = graphics(lambda: abut.Renderer(1)), graphics(lambda: abut.PictureMaker(two_boxes()))
    found = []

    def use():
        for call in (lambda: renderer.state(0), maker.make):
            try:
                call()
            except RuntimeError as error:
                found.append(str(error))

    thread = threading.Thread(target=use)
    thread.start()
    thread.join()
    assert len(found) == 2 and all("thread" in text for text in found)
    kept = []
    thread = threading.Thread(target=lambda: kept.append(abut.Renderer(1)))
    thread.start()
    thread.join()
    with pytest.raises(RuntimeError):
        kept[0].state(0)
    kept.clear()  # another thread's
    assert renderer.state(0) == abut.PartState()


def test_on_screen_and_distances():
    camera = abut.Camera((0, -4, 0), width=80, height=60)
    assert np.allclose(abut.on_screen(camera, (0, 0, 0)), (40, 30, 4))
    assert abut.on_screen(camera, (0, -9, 0)) is None
    with pytest.raises(abut.Error):
        abut.on_screen(abut.Camera(forward=(0, 0, 0)), (0, 0, 0))
    colours = abut.distances_from(3, abut.Model(*box()), ((1, 0, 0), (1, 0, 0, 0)), 5)
    assert colours.distance(0, (-1, 0.5, 0.5)) == pytest.approx(1.5) and colours.distance(3, (-1, 0, 0)) == colours.reach == 5
    assert abut.distance_colour(0).red > 200 and abut.distance_colour(1).blue > 200
    assert abut.distance_colour(float("nan")) == abut.distance_colour(9)
    for reach in (0, -1, float("nan")):
        with pytest.raises(abut.Error):
            abut.distances_from(0, abut.Model(*box()), None, reach)


def test_importing_needs_no_graphics():
    program = "import abut; print(abut.Camera().width)"
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                            env={**os.environ, "PYTHONPATH": ":".join(sys.path), "__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent"})
    assert result.stdout == "1280\n", result.stderr
