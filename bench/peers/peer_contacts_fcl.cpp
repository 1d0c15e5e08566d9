#include "peers/peer_contacts.h"

#ifdef ABUT_BENCH_FCL

#include "peers/fcl_model.h"

namespace abut::bench {

namespace {

class FclContacts final : public ContactPeer {
public:
    explicit FclContacts(const Mesh& mesh) : model_(fcl_model<fcl::OBBd>(mesh)) {}
    [[nodiscard]] std::string name() const override { return "FCL, pairs only"; }
    std::size_t contacts(const Transform& a, const Transform& b) override {
        const fcl::CollisionRequestd request(std::size_t{1} << 30U, false);
        fcl::CollisionResultd result;
        fcl::collide(model_.get(), fcl_transform(a), model_.get(), fcl_transform(b), request,
                     result);
        return result.numContacts();
    }

private:
    std::shared_ptr<const fcl::BVHModel<fcl::OBBd>> model_;
};

} // namespace

std::unique_ptr<ContactPeer> make_fcl_contacts(const Mesh& mesh) {
    return std::make_unique<FclContacts>(mesh);
}

} // namespace abut::bench

#else

namespace abut::bench {

std::unique_ptr<ContactPeer> make_fcl_contacts(const Mesh& /*mesh*/) {
    return nullptr;
}

} // namespace abut::bench

#endif
