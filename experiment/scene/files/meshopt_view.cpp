#include "experiment/scene/files/meshopt_view.h"

#include <algorithm>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "experiment/scene/files/mesh_text.h"

namespace overt {
namespace {

struct Claim {
    std::size_t count = 0, stride = 0;
    std::string mode, filter = "NONE";
};

Claim claim_of(const GltfValue& packed, std::size_t bytes) {
    Claim claim;
    claim.count = packed.at("count").whole();
    claim.stride = packed.at("byteStride").whole();
    claim.mode = packed.at("mode").text();
    if (const std::optional<GltfValue> filter = packed.find("filter"))
        claim.filter = filter->text();
    const bool is_of_vertices = claim.mode == "ATTRIBUTES";
    if (!is_of_vertices && claim.mode != "TRIANGLES" && claim.mode != "INDICES")
        packed.at("mode").fail("\"ATTRIBUTES\", \"TRIANGLES\" or \"INDICES\" is expected here.");
    if (is_of_vertices ? claim.stride == 0 || claim.stride > 256 || claim.stride % 4 != 0
                       : claim.stride != 2 && claim.stride != 4)
        packed.at("byteStride")
            .fail(is_of_vertices ? "a whole number of fours from 4 to 256 is expected here."
                                 : "2 or 4 is expected here.");
    if (claim.mode == "TRIANGLES" && claim.count % 3 != 0)
        packed.at("count").fail("whole triangles are expected here.");
    // Of vertices a byte of all 16 of a group takes four bits at least, of triangles each a byte, of indices
    // each a byte.
    constexpr std::size_t most_growth = 64;
    if (claim.count > most_growth * bytes / claim.stride)
        packed.at("count").fail(
            fmt::format("claims {} elements of {} bytes, which {} packed bytes cannot be.", claim.count,
                        claim.stride, bytes));
    return claim;
}

/// Turns what a filter made easier to pack into numbers again, in place.
void undo_filter(const GltfValue& packed, const Claim& claim, std::string& bytes) {
    if (claim.filter == "NONE")
        return;
    const GltfValue filter = packed.at("filter");
    if (claim.mode != "ATTRIBUTES")
        filter.fail("only attributes have a filter.");
    const auto expect_stride = [&](bool is_right) {
        if (!is_right)
            filter.fail(fmt::format("this filter is not for elements of {} bytes.", claim.stride));
    };
    if (claim.filter == "OCTAHEDRAL") {
        expect_stride(claim.stride == 4 || claim.stride == 8);
        meshopt_decodeFilterOct(bytes.data(), claim.count, claim.stride);
    } else if (claim.filter == "QUATERNION") {
        expect_stride(claim.stride == 8);
        meshopt_decodeFilterQuat(bytes.data(), claim.count, claim.stride);
    } else if (claim.filter == "EXPONENTIAL") {
        meshopt_decodeFilterExp(bytes.data(), claim.count, claim.stride);
    } else {
        filter.fail(fmt::format("the filter {} is not read; export without compression.",
                                MeshText::quoted(claim.filter)));
    }
}

} // namespace

bool is_meshopt_extension(std::string_view name) {
    return name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression";
}

std::string unpacked_by_meshopt(const GltfValue& packed, std::string_view bytes) {
    const Claim claim = claim_of(packed, bytes.size());
    std::string unpacked(claim.count * claim.stride, '\0');
    const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
    int failed = 0;
    if (claim.count > 0) {
        if (claim.mode == "ATTRIBUTES")
            failed =
                meshopt_decodeVertexBuffer(unpacked.data(), claim.count, claim.stride, from, bytes.size());
        else if (claim.mode == "TRIANGLES")
            failed =
                meshopt_decodeIndexBuffer(unpacked.data(), claim.count, claim.stride, from, bytes.size());
        else
            failed =
                meshopt_decodeIndexSequence(unpacked.data(), claim.count, claim.stride, from, bytes.size());
    }
    if (failed != 0)
        packed.fail("its packed bytes are damaged, or were packed by a newer meshoptimizer than overt has; "
                    "export without compression.");
    undo_filter(packed, claim, unpacked);
    return unpacked;
}

} // namespace overt
