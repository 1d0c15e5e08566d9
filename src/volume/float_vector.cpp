#include "volume/float_vector.h"

namespace abut {

Float3 to_float(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

} // namespace abut
