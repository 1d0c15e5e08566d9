#pragma once

#include <abut/mesh.h>
#include <abut/types.h>

#include <cstddef>
#include <memory>
#include <string>

namespace abut::bench {

/// Contacts of two copies of one mesh, by another library.
class ContactPeer {
public:
    ContactPeer() = default;
    ContactPeer(const ContactPeer&) = delete;
    ContactPeer& operator=(const ContactPeer&) = delete;
    virtual ~ContactPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Returns the number of contacts that it reports.
    virtual std::size_t contacts(const Transform& a, const Transform& b) = 0;
};

/// Triangle pairs without points, OBB hierarchies. Null if this program is built without FCL.
std::unique_ptr<ContactPeer> make_fcl_contacts(const Mesh& mesh);
/// GImpact meshes, in single precision. Null if this program is built without Bullet.
std::unique_ptr<ContactPeer> make_bullet_contacts(const Mesh& mesh);

} // namespace abut::bench
