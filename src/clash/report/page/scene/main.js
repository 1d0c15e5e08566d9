// The 3D view as the page uses it. The page works without it.
import { decodeBuilding } from './decode.js';
import { drawPictures, findViewpoints } from './pictures.js';
import { drawPlanPicture } from './plan_picture.js';
import { BuildingView } from './view.js';

/** Returns the view's methods for the page. host, on: see BuildingView. */
async function createView(host, report, text, on) {
  const view = new BuildingView(host, await decodeBuilding(report.building, text), report, on);
  const subjectOf = ({ clash, key, clashes }) => (clash === undefined ? view.subjectOfGroup(key, clashes) : view.subjectOfClash(clash));
  return {
    showAll: (clashes, options) => view.showAll(clashes, options),
    showClash: (clash, options) => view.showClash(clash, options),
    showGroup: (key, clashes, options) => view.showGroup(key, clashes, options),
    frame: () => view.frame(),
    set: (changes) => view.set(changes),
    setHeights: (heights) => view.set({ slice: heights && view.sliceOf(...heights) }),
    measure: (on) => view.measure.turn(on),
    orbit: (around, over) => view.camera.orbit(around, over),
    /** Finds the viewpoints of clashes and groups: [{clash or key and clashes}]. */
    findViewpoints: (list) => findViewpoints(view, list.map(subjectOf).filter(Boolean)),
    /** Draws them into canvases: [{clash or key and clashes, canvas}]. */
    drawPictures: (list) => drawPictures(view, list.map((one) => ({ subject: subjectOf(one), canvas: one.canvas })).filter(({ subject }) => subject)),
    drawPlan: (canvas, frame, level) => drawPlanPicture(view, canvas, frame, level),
    /** The lowest height of a part of the report; null if it is not in the view. */
    bottomOf: (number) => view.bottomOf(number),
    /** Calls take(canvas) while the canvas has a picture. */
    capture(take) {
      view.draw();
      take(view.canvas);
    },
    /** What the tests look at. */
    inspect: () => ({
      subject: view.state.subject?.key ?? null, eye: view.camera.camera.position.toArray(),
      target: view.camera.controls.target.toArray(), flying: view.camera.flying,
      viewpoint: view.viewpoints.get(view.state.subject?.key) ?? null,
      drawn: view.renderer.info.render.triangles, dots: view.marks.shown.length,
      rest: view.state.rest, section: view.state.section, slice: view.state.slice,
    }),
    view,
  };
}

globalThis.abutReport?.attachScene(createView);
