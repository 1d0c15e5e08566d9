#pragma once

#include <abut/bcf.h>
#include <abut/clash_viewpoint.h>
#include <abut/scene.h>

#include <string>
#include <vector>

namespace abut {

/// Returns a component: with the GlobalId if the id is one, else with the id and the model's file.
BcfComponent component_of_part(const std::string& file, const std::string& id);

/// Returns a vector of a frame as BCF has it, with z up.
Vec3 with_z_up(const Vec3& v, UpAxis up);

/// Returns a viewpoint of BCF that shows both sides in their colours and the parts near them.
///
/// In          up: of the report's frame; models: of the report; topic: GUID of the topic.
BcfViewpoint topic_viewpoint(const ClashViewpoint& view, UpAxis up,
                             const std::vector<Scene>& models, const std::string& topic, bool clip);

} // namespace abut
