#include "io/scene_source.h"
namespace abut {
std::unique_ptr<SceneSource> open_stl_source(const std::string&, const SourceOptions&) {
    return nullptr;
}
} // namespace abut
