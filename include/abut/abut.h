#pragma once

/// The whole library. One header a subject; each can be included alone.
#include <abut/batch.h>
#include <abut/broad_phase.h>
#include <abut/clash.h>
#include <abut/clash_review.h>
#include <abut/convex.h>
#include <abut/convex_pieces.h>
#include <abut/deformable.h>
#include <abut/elementary_impact.h>
#include <abut/error.h>
#include <abut/frame.h>
#include <abut/mesh.h>
#include <abut/model.h>
#include <abut/motion.h>
#include <abut/penetration.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/scene.h>
#include <abut/shape_queries.h>
#include <abut/shapes.h>
#include <abut/store.h>
#include <abut/store_clash.h>
#include <abut/types.h>
#include <abut/volume.h>
#include <abut/world.h>
