#include "toolbox/clash_list.h"

#include <abut/error.h>
#include <abut/store_clash.h>

#include <algorithm>

namespace abut::viewer {

namespace {

constexpr double kSecondsForIds = 0.005;               ///< of a frame
constexpr double kLeastAspect = 0.1, kMostAspect = 10; ///< of ViewpointOptions
constexpr std::uint64_t kLeastJobMemory = std::uint64_t{64} << 20;

} // namespace

void ClashList::read(Session& session) {
    try {
        reviews = review_clashes(session.store);
        message = reviews.empty() ? "no clash job has finished" : "";
    } catch (const Error& error) {
        message = error.what();
    }
    is_read = true;
}

void ClashList::run_job(Session& session) {
    if (job.is_running())
        return;
    message.clear();
    ClashOptions options;
    options.clearance = clearance;
    OutOfCoreOptions out_of_core;
    out_of_core.memory = std::max(kLeastJobMemory, session.memory / 4);
    job.start([path = session.path, options, out_of_core](const Progress& progress) {
        ClashOptions with_progress = options;
        with_progress.progress = progress;
        (void)find_clashes(open_store(path, {.read_only = false}), with_progress, out_of_core);
    });
}

std::size_t ClashList::count() const {
    std::size_t clashes = 0;
    for (const ClashReview& review : reviews)
        clashes += static_cast<std::size_t>(
            std::count_if(review.clashes.begin(), review.clashes.end(),
                          [](const ListedClash& c) { return c.status != ClashStatus::resolved; }));
    return clashes;
}

const ListedClash* ClashList::find(std::uint64_t id) const {
    for (const ClashReview& review : reviews)
        for (const ListedClash& clash : review.clashes)
            if (clash.id == id)
                return &clash;
    return nullptr;
}

void ClashList::change(Session& session, const MarkChanges& changes) {
    mark_clashes(open_store(session.path, {.read_only = false}), changes);
    read(session);
}

void ClashList::mark(Session& session, ClashStatus as) {
    const ListedClash* clash = shown ? find(*shown) : nullptr;
    if (clash == nullptr)
        return;
    MarkChanges changes;
    (as == ClashStatus::approved ? changes.approved : changes.reviewed) = {clash->id};
    changes.note = note;
    change(session, changes);
}

void ClashList::write_note(Session& session) {
    const ListedClash* clash = shown ? find(*shown) : nullptr;
    if (clash != nullptr)
        mark(session, clash->status == ClashStatus::approved ? ClashStatus::approved
                                                             : ClashStatus::reviewed);
}

void ClashList::clear_mark(Session& session) {
    if (!shown)
        return;
    MarkChanges changes;
    changes.cleared = {*shown};
    change(session, changes);
    note.clear();
}

void ClashList::show_next(Session& session) {
    if (!is_read)
        read(session);
    const ListedClash* first = nullptr;
    bool was_shown = false;
    for (const ClashReview& review : reviews)
        for (const ListedClash& clash : review.clashes) {
            if (clash.status == ClashStatus::resolved)
                continue;
            if (was_shown) {
                wanted = clash;
                return;
            }
            first = first == nullptr ? &clash : first;
            was_shown = shown == clash.id;
        }
    if (first != nullptr)
        wanted = *first;
}

void ClashList::end_job(Session& session) {
    const std::string error = job.error();
    read(session);
    if (!error.empty())
        message = job.was_interrupted() ? "the job was stopped" : error;
    if (session.colour_by == ColourBy::clash)
        session.colour(ColourBy::clash);
    session.changed = true;
}

bool ClashList::aim(const Session& session) {
    if (aiming.has_ended() && wanted && wanted->id == aimed_at_) {
        is_aimed_ = aiming.error().empty();
        if (!is_aimed_ && !aiming.was_interrupted()) {
            message = aiming.error();
            wanted.reset();
        }
    }
    if (!wanted || (is_aimed_ && wanted->id == aimed_at_))
        return wanted.has_value();
    if (aiming.is_running()) {
        if (wanted->id != aimed_at_)
            aiming.stop();
        return false;
    }
    is_aimed_ = false;
    aimed_at_ = wanted->id;
    viewpoint_ = std::make_shared<ClashViewpoint>();
    ViewpointOptions options;
    options.fov = session.lens.field_of_view;
    options.aspect = std::clamp(static_cast<double>(session.lens.width) / session.lens.height,
                                kLeastAspect, kMostAspect);
    aiming.start([store = session.store, clash = *wanted, options,
                  found = viewpoint_](const Progress& progress) {
        ViewpointOptions with_progress = options;
        with_progress.progress = progress;
        *found = clash_viewpoint(store, clash, with_progress);
    });
    return false;
}

void ClashList::update(Session& session) {
    if (job.has_ended())
        end_job(session);
    if (!aim(session) || !session.learn_ids(kSecondsForIds))
        return;
    shown = wanted->id;
    note = wanted->note;
    message =
        session.show_clash(*wanted, *viewpoint_) ? "" : "a part of this clash is not in this walk";
    wanted.reset();
    is_aimed_ = false; // a later visit finds it anew: the window may have another shape
}

} // namespace abut::viewer
