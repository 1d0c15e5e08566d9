"""Scenes, clashes, stores and walks."""

import json

import numpy as np
import pytest

import abut
from shapes import box, guard, matrix, random_poses, soup, sphere


def random_scene(rng, count, name, spread=1.5):
    meshes = [abut.Mesh(*soup(rng, 6, 0.4)), abut.Mesh(*box((0.5, 0.4, 0.3)))]
    poses = random_poses(rng, count, spread)
    parts = [abut.Part(f"{name}{i}", i % 2, poses[i], name=f"part {i}", type="Pipe") for i in range(count)]
    return abut.Scene(meshes, parts, file=f"{name}.glb", up="y")


def meeting_pairs(a, b):
    """Pairs of parts whose surfaces share a point, by a query for each pair."""
    models_a, models_b = ([abut.Model(mesh) for mesh in scene.meshes] for scene in (a, b))
    return {(p.id, q.id) for p in a.parts for q in b.parts
            if abut.collide(models_a[p.mesh], p.world_from_mesh, models_b[q.mesh], q.world_from_mesh)}


@pytest.fixture
def scenes(rng):
    return random_scene(rng, 20, "a"), random_scene(rng, 15, "b")


def write(scenes, folder):
    paths = []
    for scene in scenes:
        paths.append(folder / scene.file)
        abut.write_glb(scene, paths[-1])
    return paths


def test_clashes_of_scenes(scenes):
    a, b = scenes
    seen = []
    report = abut.find_clashes([a, b], progress=lambda stage, fraction: seen.append(stage))
    expected = meeting_pairs(a, b)
    guard([(p.id, q.id) in expected for p in a.parts for q in b.parts], 0.01, 0.6)
    found = {clash.part_ids[0]: [] for clash in report.clashes}
    surfaces = {(c.part_ids[0], c.part_ids[1]) for c in report.clashes if c.kind != abut.ClashKind.contained}
    assert surfaces == expected and len(report) == len(report.clashes) and seen and found
    assert sum(report.counts.values()) == len(report) and report.statuses is None and report.counters is None
    clash = report.clashes[0]
    assert clash.files == ["a.glb", "b.glb"] and clash.types == ["Pipe", "Pipe"] and len(clash.id) == 16
    assert clash.point_a.shape == (3,) and "Clash(" in repr(clash)
    assert json.loads(abut.to_json(report))["clashes"][0]["id"] == clash.id
    near = abut.find_clashes([a, b], clearance=0.1)
    assert len(near) > len(report) and near.clearance == 0.1
    with pytest.raises(abut.Error) as error:
        abut.find_clashes([a, b], clearance=-1)
    assert error.value.code is abut.ErrorCode.bad_argument


def test_rules(scenes, tmp_path):
    rule = abut.ClashRule("all touch", abut.PartSelector(name=["part *"]), abut.PartSelector(), touch_tolerance=0.4)
    touching = abut.find_clashes(scenes, rules=[rule])
    exact = abut.find_clashes(scenes, touch_tolerance=0)
    assert touching.counts["hard"] < exact.counts["hard"] and touching.counts["touch"] > exact.counts["touch"]
    assert {clash.rule for clash in touching.clashes} == {"all touch"}
    assert "IgnoreRule(" in repr(rule)
    path = tmp_path / "rules.json"
    path.write_text('{"rules": 3}')
    with pytest.raises(abut.Error) as error:
        abut.find_clashes(scenes, rules=path)
    assert error.value.code is abut.ErrorCode.malformed and error.value.file == str(path)


def test_reports_are_written(scenes, tmp_path):
    report = abut.find_clashes(scenes)
    abut.write_clash_json(report, tmp_path / "r.json")
    abut.write_clash_csv(report, tmp_path / "r.csv")
    abut.write_clash_html(report, tmp_path / "r.html")
    assert len(json.loads((tmp_path / "r.json").read_text())["clashes"]) == len(report)
    assert (tmp_path / "r.html").read_text().startswith("<!")
    abut.write_clash_html(report, tmp_path / "3d.html", scenes)
    abut.write_clash_html(report, tmp_path / "list.html", scenes, building_bytes=0)
    assert "\"building\":" not in (tmp_path / "list.html").read_text()
    assert len((tmp_path / "3d.html").read_text()) >= len((tmp_path / "list.html").read_text())
    with pytest.raises(abut.Error) as error:
        abut.write_clash_csv(report, tmp_path / "no" / "r.csv")
    assert error.value.code is abut.ErrorCode.cannot_write and error.value.file


def test_files(scenes, tmp_path):
    paths = write(scenes, tmp_path)
    again = abut.read_scene(paths[0])
    assert [part.id for part in again.parts] == [part.id for part in scenes[0].parts]
    assert np.allclose(again.parts[3].world_from_mesh, scenes[0].parts[3].world_from_mesh)
    assert [scene.file for scene in abut.read_scenes(paths)] == [str(path) for path in paths]
    assert len(abut.read_mesh(paths[0]).faces) == sum(len(again.meshes[part.mesh].faces) for part in again.parts)
    path = abut.parse_model_path("pump.stl:mm")
    assert path.path == "pump.stl" and path.unit == 0.001 and path.up is None
    assert abut.into_one_frame([scenes[0], abut.Scene([], [], up="z")])[1].up is abut.UpAxis.y
    report = abut.find_clashes(paths)
    assert [clash.part_ids for clash in report.clashes] == [clash.part_ids for clash in abut.find_clashes(scenes).clashes]
    with pytest.raises(abut.Error) as error:
        abut.read_scene(tmp_path / "none.glb")
    assert error.value.code is abut.ErrorCode.file_not_found and error.value.file.endswith("none.glb")
    with pytest.raises(IndexError):
        abut.Scene([], [abut.Part("x")])


@pytest.fixture
def store_path(scenes, tmp_path):
    path = tmp_path / "plant.abut"
    report = abut.import_models(write(scenes, tmp_path), path)
    assert [model.outcome for model in report.models] == [abut.ImportOutcome.added] * 2
    return path


def test_store(scenes, store_path):
    assert abut.is_store(store_path) and not abut.is_store(__file__)
    in_memory = abut.find_clashes([str(store_path.parent / scene.file) for scene in scenes])
    with abut.open_store(store_path, read_only=False) as store:
        assert abut.summary(store).parts == 35 and not store.closed
        abut.verify(store)
        report = abut.find_clashes(store)
        assert [clash.id for clash in report.clashes] == [clash.id for clash in in_memory.clashes]
        assert report.counters.kept and report.counters.workers and report.statuses["new"] == len(report)
        assert "out_of_core" in json.loads(abut.to_json(report))
        graph = abut.overlap_graph(store, lines=5)
        assert graph.nodes == 35 and graph.edges == report.candidates and graph.lines.shape[1:] == (2, 3)
        assert sum(unit.edges for unit in graph.units) + graph.cut_edges >= graph.edges > 0
        abut.mark_clashes(store, approved=[report.clashes[0].id], note="sleeve")
        review, = abut.review_clashes(store)
        assert review.statuses["approved"] == 1 and len(review.clashes) == len(report)
        assert json.loads(abut.to_json(review)) and json.loads(abut.to_json([review], "plant.abut"))
        assert abut.forget_resolved_clashes(store) == 0
        abut.verify_jobs(store)
        again = abut.find_clashes(store, **abut.last_clash_options(store))
        assert [clash.id for clash in again.clashes] == [clash.id for clash in report.clashes]
        abut.group_clashes(again, store=store)
        assert abut.ClashQuery("group.size >= 1").find(again) == list(range(len(again)))
        assert abut.ClashQuery("topic.status = *").find(again) == []
        assert {topic.status for topic in abut.untouched_topics(store)} == {"open"}
        with pytest.raises(ValueError, match="no id"):
            abut.mark_clashes(store, approved=["zz"])
    assert store.closed and "closed" in repr(store)
    for use in (lambda: abut.summary(store), lambda: abut.find_clashes(store), lambda: abut.Walk(store),
                lambda: abut.verify(store)):
        with pytest.raises(ValueError, match="closed"):
            use()
    with abut.open_store(store_path) as store:
        with pytest.raises(abut.Error) as error:
            abut.mark_clashes(store, approved=[])
            abut.mark_clashes(store, cleared=[report.clashes[0].id])
        assert error.value.code is abut.ErrorCode.cannot_write
    removed = abut.remove_models([store_path.parent / "a.glb"], store_path)
    assert removed.models[0].parts == 20


def test_store_errors(tmp_path):
    with pytest.raises(abut.Error) as error:
        abut.open_store(tmp_path / "none.abut")
    assert error.value.code is abut.ErrorCode.file_not_found
    damaged = tmp_path / "damaged.abut"
    damaged.write_bytes(b"SQLite format 3\0" + bytes(2000))
    with pytest.raises(abut.Error) as error:
        abut.open_store(damaged)
    assert error.value.file == str(damaged)


def test_walk(scenes, store_path, rng):
    store = abut.open_store(store_path)
    walk = abut.Walk(store, memory=64 << 20)
    store.close()  # the walk keeps the file open
    files = {name: scene for name, scene in zip("ab", scenes)}
    probe = abut.Probe(abut.Model(*sphere(6, 0.4)))
    ball = abut.Model(*sphere(6, 0.4))
    walk.move_to((0, 0, 0), (0, 0, 0))
    walk.wait()
    hits = []
    for pose in random_poses(rng, 20, 1.5):
        expected = []
        for number in range(1, 36):
            name = walk.name(number)
            scene = files[name.file.rsplit("/", 1)[-1][0]]
            part, = (part for part in scene.parts if part.id == name.id)
            model = abut.Model(scene.meshes[part.mesh])
            expected.append(abut.distance(model, part.world_from_mesh, ball, pose).distance)
        touched = walk.collide(probe, pose)
        meets = np.array(expected) < 1e-6
        assert touched.complete and set(touched.parts) == {number + 1 for number in np.flatnonzero(meets)}
        hits += meets.tolist()
        nearest = walk.distance(probe, pose)
        assert nearest.found and nearest.gap.distance == pytest.approx(min(expected), abs=1e-5)
        near = walk.within(ball, pose, 0.2)
        assert set(near.parts.part) == {number + 1 for number in np.flatnonzero(np.array(expected) <= 0.2)}
        assert set(walk.penetration(probe, pose).parts.part) == set(touched.parts)
    guard(hits, 0.01)
    added = walk.add(ball, matrix((50, 0, 0)))
    assert added < 0 and walk.collide(abut.Sphere((0, 0, 0), 1), matrix((50, 0, 0))).parts.tolist() == [added]
    walk.move(added, matrix((60, 0, 0)))
    assert walk.world_from_part(added)[0, 3] == 60
    assert len(walk.model(added).faces) == len(ball.faces)
    walk.remove(added)
    assert walk.distance(probe, matrix((60, 0, 0)), upper_bound=0.1).found is False
    assert walk.statistics.lookups > 0 and "WalkStatistics(" in repr(walk.statistics)
    with pytest.raises(abut.Error):
        walk.name(999)
    with pytest.raises(abut.Error):
        walk.within(probe, None, -1)


def test_crew_of_one():
    assert abut.join_crew() is None and not abut.is_helper()


def test_an_import_that_is_stopped(scenes, tmp_path):
    paths, store_path = write(scenes, tmp_path), tmp_path / "plant.abut"

    def stop(stage, fraction):
        raise LookupError("enough")

    with pytest.raises(LookupError):
        abut.import_models(paths, store_path, progress=stop)
    assert {path.name for path in tmp_path.iterdir()} <= {"a.glb", "b.glb", "plant.abut"}
    abut.import_models(paths, store_path)
    with abut.open_store(store_path) as store:
        abut.verify(store)
        assert abut.summary(store).parts == 35
        with pytest.raises(LookupError):
            abut.find_clashes(store, clearance=0.1, progress=stop)
        assert len(abut.find_clashes(store, clearance=0.1)) > 0


def test_conditions_matrix_and_volume(scenes):
    query = abut.PartQuery("type = IfcWall* and not (storey = L2)")
    assert query.text == "type = IfcWall* and not storey = L2" and query.names() == ["storey", "type"]
    with pytest.raises(abut.Error, match="at character 6"):
        abut.PartQuery("type IfcWall")
    report = abut.find_clashes(scenes, sort="volume")
    worst = report.clashes[0]
    assert worst.volume_error >= 0 and report.left_out["not_selected"] == 0
    assert abut.ranked_clashes(report) == list(range(len(report)))
    assert abut.ClashQuery("any").matches(report, 0) and not abut.ClashQuery("severity = high").matches(report, 0)
    none = abut.find_clashes(scenes, only="not id = *")
    assert len(none) == 0 and none.left_out["not_selected"] > 0
    with pytest.raises(abut.Error, match='no part has the id "nothing"; the nearest'):
        abut.find_clashes(scenes, only="id = nothing")
    assert abut.find_clashes(scenes, matrix="architecture").matrix.groups == ["architecture", "structure", "services"]
