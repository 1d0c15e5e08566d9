#pragma once

/// The whole library. One header a subject; each can be included alone.
#include <abut/clash.h>
#include <abut/error.h>
#include <abut/mesh.h>
#include <abut/model.h>
#include <abut/penetration.h>
#include <abut/progress.h>
#include <abut/rigid.h>
#include <abut/scene.h>
#include <abut/types.h>
