/// A mesh that several may have without having it several times.
#pragma once

#include <memory>
#include <utility>

#include "experiment/scene/mesh.h"

namespace overt {

/// A mesh that is not changed any more. Copies are the same mesh in memory, so that a hundred objects of one
/// shape take no more than one. From any thread.
class SharedMesh {
  public:
    /// Without triangles.
    SharedMesh() : SharedMesh(Mesh()) {}
    // Wherever a mesh is given, it may be: it is taken as it stands.
    SharedMesh(Mesh mesh) : mesh_(std::make_shared<const Mesh>(std::move(mesh))) {}

    operator const Mesh&() const noexcept { return *mesh_; }
    const Mesh& operator*() const noexcept { return *mesh_; }
    const Mesh* operator->() const noexcept { return mesh_.get(); }

    /// Both are one in memory.
    bool is_same_as(const SharedMesh& other) const noexcept { return mesh_ == other.mesh_; }

  private:
    std::shared_ptr<const Mesh> mesh_;
};

} // namespace overt
