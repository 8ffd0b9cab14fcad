/// The bytes that a glTF file's JSON speaks of: in the .glb, in the JSON itself, or in files beside it.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/scene/files/gltf_json.h"

namespace overt {

/// Reads each buffer when it is first asked for, and keeps it. Views live as long as it does.
class GltfBuffers {
  public:
    /// All must outlive it.
    GltfBuffers(const GltfValue& root, const GltfContent& content) : root_(root), content_(&content) {}

    struct View {
        std::string_view bytes;
        std::size_t stride = 0; ///< from one element to the next; 0: they follow one another
    };
    /// Of the buffer view that `index` names, unpacked where meshoptimizer packed it. Throws InputError for
    /// one that leaves its buffer.
    View view(const GltfValue& index);

    /// What a URI leads to: the bytes of a data: URI, or of a file in the folder of the mesh. Throws
    /// InputError at `uri` for anything else. `media_type` gets what a data: URI says of itself.
    std::string_view resource(const GltfValue& uri, std::string* media_type = nullptr);

    /// The names of the files that were read by now.
    std::vector<std::string> files() const;

    /// How many bytes were read by now, with those of the file itself, and unpacked of them.
    std::size_t bytes_there() const { return bytes_read() + unpacked_bytes_; }

  private:
    std::string_view buffer(const GltfValue& index);
    /// That an object names by "buffer", "byteOffset" and "byteLength".
    std::string_view bytes_of(const GltfValue& place);
    std::string_view unpacked(std::size_t view, const GltfValue& packed);
    std::size_t bytes_read() const { return bytes_there_ + root_.source().bytes().size(); }

    GltfValue root_;
    const GltfContent* content_;
    std::deque<std::string> kept_; // views of these stay where they are
    std::map<std::size_t, std::string_view> buffers_;
    std::map<std::string, std::string_view> resources_; ///< by the whole URI
    std::map<std::size_t, std::string_view> unpacked_;  ///< by the number of the view
    std::size_t bytes_there_ = 0, unpacked_bytes_ = 0;
};

} // namespace overt
