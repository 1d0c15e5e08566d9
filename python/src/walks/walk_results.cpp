#include "walks/open_walk.h"

namespace abut::python {

namespace {

template <class Answer>
void add_answer(PlainBinder<Answer>& binder) {
    binder
        .field("complete", &WalkAnswer::complete,
               "False if parts that may matter were not in memory and skipped")
        .field("candidates", &WalkAnswer::candidates, "parts whose boxes were in reach")
        .field("misses", &WalkAnswer::misses, "of these, those that were not in memory");
}

void bind_near_parts(py::module_& module) {
    RecordBinder<WalkGap>(module, "WalkGap",
                          "How a part and the probe lie to each other, world frame.")
        .field("part", &WalkGap::part, "number of the part")
        .field("distance", &WalkGap::distance, "length; 0 if they touch, negative: minus the depth")
        .field("point_part", &WalkGap::point_part, "on the part")
        .field("point_probe", &WalkGap::point_probe, "on the probe")
        .field("normal", &WalkGap::normal, "unit vector from the part to the probe")
        .field("triangle_part", &WalkGap::triangle_part, "of a mesh; else 0")
        .field("triangle_probe", &WalkGap::triangle_probe, "of a mesh; else 0")
        .field("status", &WalkGap::status, "Status")
        .done();
    PlainBinder<NearestPart> nearest(module, "NearestPart", "Returned by Walk.distance.");
    nearest.field("found", &NearestPart::found, "else no part is nearer than the bound")
        .field("gap", &NearestPart::gap, "WalkGap")
        .field("at_least", &NearestPart::at_least, "no part is nearer");
    add_answer(nearest);
    PlainBinder<NearParts> near(module, "NearParts",
                                "Returned by Walk.within and Walk.penetration.");
    near.property(
        "parts", [](const NearParts& self) { return records(self.parts); },
        "record array of WalkGap, sorted by part");
    add_answer(near);
    PlainBinder<TouchedParts> touched(module, "TouchedParts", "Returned by Walk.collide.");
    touched.property(
        "parts", [](const TouchedParts& self) { return part_numbers(self.parts); },
        "int64 array of shape (n,), sorted");
    add_answer(touched);
}

void bind_met_parts(py::module_& module) {
    PlainBinder<HitPart> hit(module, "HitPart",
                             "Returned by Walk.first_hit. True if the ray meets a part.");
    hit.field("meet", &HitPart::meet, "if False, only at_least is set")
        .property(
            "part", [](const HitPart& self) { return self.part.number; }, "number of the part")
        .field("t", &HitPart::t, "the ray's parameter")
        .field("point", &HitPart::point, "array of shape (3,), world frame")
        .field("triangle", &HitPart::triangle, "of the part's mesh")
        .property(
            "barycentric", [](const HitPart& self) { return to_python(self.barycentric); },
            "weights of the triangle's vertices")
        .field("side", &HitPart::side, "HitSide")
        .field("at_least", &HitPart::at_least, "no part is met at a smaller parameter");
    add_answer(hit);
    hit.done().def("__bool__", [](const HitPart& self) { return self.meet; });
    RecordBinder<PartImpact>(module, "PartImpact", "When a moving probe first meets a part.")
        .field("part", &PartImpact::part, "number of the part")
        .field("time", &PartImpact::time, "in [0, 1], never later than the contact")
        .field("contact_time", &PartImpact::contact_time, "a time at which they are in contact")
        .field("gap", &PartImpact::gap, "length: how far apart they are at `time`, at most")
        .field("point_part", &PartImpact::point_part, "on the part at `time`")
        .field("point_probe", &PartImpact::point_probe, "on the probe at `time`")
        .field("normal", &PartImpact::normal, "unit vector from the part to the probe, or zero")
        .field("triangle_part", &PartImpact::triangle_part, "of a mesh; else 0")
        .field("triangle_probe", &PartImpact::triangle_probe, "of a mesh; else 0")
        .field("status", &PartImpact::status, "Status")
        .done();
    PlainBinder<FirstContact> first(
        module, "FirstContact",
        "Returned by Walk.sweep and Walk.time_of_impact. True if the probe meets a part.");
    first.field("meet", &FirstContact::meet, "if False, impact is not set")
        .field("impact", &FirstContact::impact, "PartImpact")
        .field("time_free", &FirstContact::time_free,
               "in [0, 1]: until then no part is met, whether it is in memory or not");
    add_answer(first);
    first.done().def("__bool__", [](const FirstContact& self) { return self.meet; });
    PlainBinder<PartsInWay> way(module, "PartsInWay", "Returned by Walk.parts_in_way.");
    way.property(
           "parts", [](const PartsInWay& self) { return records(self.parts); },
           "record array of PartImpact, sorted by time, then by part")
        .field("time_free", &PartsInWay::time_free, "as FirstContact.time_free");
    add_answer(way);
}

} // namespace

void bind_walk_results(py::module_& module) {
    bind_near_parts(module);
    bind_met_parts(module);
    PlainBinder<WalkPartName>(module, "WalkPartName", "A part by name.")
        .field("file", &WalkPartName::file, "empty for a part that was added")
        .field("id", &WalkPartName::id, "")
        .field("name", &WalkPartName::name, "")
        .field("type", &WalkPartName::type, "")
        .done();
    PlainBinder<WalkStatistics>(module, "WalkStatistics", "What a walk did since it began.")
        .field("lookups", &WalkStatistics::lookups, "")
        .field("misses", &WalkStatistics::misses, "")
        .field("seconds_waited", &WalkStatistics::seconds_waited, "")
        .field("read_ahead", &WalkStatistics::read_ahead, "")
        .field("read_in_query", &WalkStatistics::read_in_query, "")
        .field("evicted", &WalkStatistics::evicted, "")
        .field("parts_in_memory", &WalkStatistics::parts_in_memory, "")
        .field("table_bytes", &WalkStatistics::table_bytes, "")
        .field("bytes", &WalkStatistics::bytes, "")
        .field("peak_bytes", &WalkStatistics::peak_bytes, "")
        .done();
}

} // namespace abut::python
