#include "experiment/scene/files/draco_primitive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <fmt/format.h>

#include "experiment/scene/files/mesh_text.h"

namespace overt {

struct DracoPrimitive::Unpacked {
    std::unique_ptr<draco::Mesh> mesh;
};

namespace {

/// Triangles that Draco makes of so many bytes: at its best it takes less than a bit for each, of surfaces
/// without a form of their own.
constexpr std::uint64_t always = 4096, for_each_byte = 64;

[[noreturn]] void fail_as_damaged(const GltfValue& packed) {
    packed.fail(
        "its packed bytes are damaged, or were packed by another Draco than overt has; export without "
        "compression.");
}

/// How many triangles the bytes claim, which Draco itself makes room for before it looks further.
std::uint64_t claimed_triangles(const GltfValue& packed, std::string_view bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok())
        fail_as_damaged(packed);
    if (header.encoder_type != draco::TRIANGULAR_MESH)
        packed.fail("these are points, not triangles: mesh them first.");
    const auto version =
        static_cast<std::uint16_t>(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
    buffer.set_bitstream_version(version);
    if (version >= DRACO_BITSTREAM_VERSION(1, 3) && (header.flags & METADATA_FLAG_MASK) != 0) {
        draco::GeometryMetadata metadata;
        if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata))
            fail_as_damaged(packed);
    }
    std::uint32_t vertices = 0, triangles = 0;
    const auto number = [&](std::uint32_t& to, std::uint16_t varied_since) {
        return version < varied_since ? buffer.Decode(&to) : draco::DecodeVarint(&to, &buffer);
    };
    bool is_there = true;
    if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
        is_there = number(triangles, DRACO_BITSTREAM_VERSION(2, 2)) &&
                   number(vertices, DRACO_BITSTREAM_VERSION(2, 2));
    } else {
        std::uint8_t traversal = 0;
        std::uint32_t further_vertices = 0;
        is_there = buffer.Decode(&traversal) &&
                   (version >= DRACO_BITSTREAM_VERSION(2, 2) ||
                    number(further_vertices, DRACO_BITSTREAM_VERSION(2, 0))) &&
                   number(vertices, DRACO_BITSTREAM_VERSION(2, 0)) &&
                   number(triangles, DRACO_BITSTREAM_VERSION(2, 0));
        vertices = std::max(vertices, further_vertices);
    }
    if (!is_there)
        fail_as_damaged(packed);
    if (std::max<std::uint64_t>(triangles, vertices / 3) > always + for_each_byte * bytes.size())
        packed.fail(
            fmt::format("its packed bytes claim {} triangles of {} vertices, which {} bytes cannot be.",
                        triangles, vertices, bytes.size()));
    return triangles;
}

} // namespace

DracoPrimitive::DracoPrimitive(const GltfValue& packed, std::string_view bytes,
                               std::optional<std::uint64_t> corners)
    : packed_(packed), unpacked_(std::make_unique<Unpacked>()) {
    if (const std::uint64_t triangles = claimed_triangles(packed, bytes);
        corners && 3 * triangles != *corners)
        packed.fail(fmt::format("its packed bytes have {} triangles, and its indices say {} corners.",
                                triangles, *corners));
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    // A decoder keeps what it read: never one for two meshes.
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        fail_as_damaged(packed);
    unpacked_->mesh = std::move(decoded).value();
    const draco::Mesh& mesh = *unpacked_->mesh;
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& corner : mesh.face(face))
            if (corner >= mesh.num_points())
                fail_as_damaged(packed);
}

DracoPrimitive::~DracoPrimitive() = default;
DracoPrimitive::DracoPrimitive(DracoPrimitive&&) noexcept = default;

std::size_t DracoPrimitive::vertex_count() const { return unpacked_->mesh->num_points(); }

std::vector<std::uint32_t> DracoPrimitive::corners() const {
    const draco::Mesh& mesh = *unpacked_->mesh;
    std::vector<std::uint32_t> corners;
    corners.reserve(std::size_t{3} * mesh.num_faces());
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& corner : mesh.face(face))
            corners.push_back(corner.value());
    return corners;
}

bool DracoPrimitive::has(std::string_view attribute) const {
    return packed_.at("attributes").find(attribute).has_value();
}

GltfNumbers DracoPrimitive::numbers(std::string_view attribute, const GltfAccessors::Form& form) const {
    const draco::Mesh& mesh = *unpacked_->mesh;
    const GltfValue id = packed_.at("attributes").at(attribute);
    const draco::PointAttribute* const values =
        mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id.whole(0xffffffff)));
    if (!values)
        id.fail(fmt::format("its packed bytes have no attribute {}.", id.whole()));
    if (values->num_components() != static_cast<int>(form.components))
        id.fail(fmt::format("its packed bytes have {} numbers for each vertex, and its accessor {}.",
                            static_cast<int>(values->num_components()), form.components));
    if (form.count != mesh.num_points())
        id.fail(fmt::format("its packed bytes have {} vertices, and its accessor {}.", mesh.num_points(),
                            form.count));
    const bool is_float =
        values->data_type() == draco::DT_FLOAT32 || values->data_type() == draco::DT_FLOAT64;
    GltfNumbers numbers{form.components, {}, form.is_normalised};
    numbers.values.resize(form.components * form.count);
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        const draco::AttributeValueIndex at = values->mapped_index(point);
        float* const to = &numbers.values[point.value() * form.components];
        bool is_there = at.value() < values->size();
        if (is_there && is_float) {
            is_there = values->ConvertValue(at, static_cast<std::int8_t>(form.components), to);
        } else if (is_there) {
            // As they are stored: whether they are normalised is the accessor's to say.
            std::array<std::int64_t, 4> whole{};
            is_there = values->ConvertValue(at, static_cast<std::int8_t>(form.components), whole.data());
            for (std::size_t i = 0; i < form.components; ++i)
                to[i] = static_cast<float>(form.value_of(static_cast<double>(whole[i])));
        }
        for (std::size_t i = 0; i < form.components; ++i)
            is_there = is_there && std::isfinite(to[i]);
        if (!is_there)
            id.fail(fmt::format("its packed bytes have no number for vertex {}.", point.value()));
    }
    return numbers;
}

} // namespace overt
