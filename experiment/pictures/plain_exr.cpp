#include "experiment/pictures/plain_exr.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfIntAttribute.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTestFile.h>
#include <ImfVecAttribute.h>

#include "experiment/pictures/picture_file.h"

namespace overt {

namespace {

struct StoredType {
    Imf::PixelType stored;
    PixelType type;
    const char* name;
    std::size_t bytes;
};
constexpr StoredType stored_types[] = {{Imf::UINT, PixelType::bits32, "uint", 4},
                                       {Imf::HALF, PixelType::float16, "half", 2},
                                       {Imf::FLOAT, PixelType::float32, "float", 4}};

constexpr struct {
    Imf::Compression stored;
    const char* name;
} compressions[] = {{Imf::ZIP_COMPRESSION, "zip"}, {Imf::PXR24_COMPRESSION, "pxr24"}};

const StoredType* stored_as(PixelType type) {
    const auto* const row = std::ranges::find(stored_types, type, &StoredType::type);
    return row == std::end(stored_types) ? nullptr : row;
}

void read_attribute(const std::string& name, const Imf::Attribute& attribute, PictureHeader& into) {
    if (const auto* const text = dynamic_cast<const Imf::StringAttribute*>(&attribute))
        into.attributes.emplace_back(name, text->value());
    else if (const auto* const number = dynamic_cast<const Imf::IntAttribute*>(&attribute))
        into.attributes.emplace_back(name, number->value());
    else if (const auto* const real = dynamic_cast<const Imf::DoubleAttribute*>(&attribute))
        into.attributes.emplace_back(name, real->value());
    else if (const auto* const triple = dynamic_cast<const Imf::V3dAttribute*>(&attribute))
        into.attributes.emplace_back(name,
                                     glm::dvec3(triple->value().x, triple->value().y, triple->value().z));
}

/// Nothing if a file with this header is left to OpenImageIO.
std::optional<PictureHeader> plain_header_of(const Imf::Header& stored) {
    const auto& window = stored.dataWindow();
    const auto* const compression =
        std::ranges::find(compressions, stored.compression(), [](const auto& row) { return row.stored; });
    if (compression == std::end(compressions) || window != stored.displayWindow() || window.min.x != 0 ||
        window.min.y != 0)
        return std::nullopt;
    PictureHeader header;
    header.size_px = {window.max.x + 1, window.max.y + 1};
    const StoredType* type = nullptr;
    for (auto channel = stored.channels().begin(); channel != stored.channels().end(); ++channel) {
        const auto* const own = std::ranges::find(stored_types, channel.channel().type, &StoredType::stored);
        if (own == std::end(stored_types) || (type && type != own) || channel.channel().xSampling != 1 ||
            channel.channel().ySampling != 1)
            return std::nullopt;
        type = own;
        header.channels.emplace_back(channel.name());
    }
    // The format has channels in the order of the alphabet: these in the one in which they are wanted.
    if (!type || (header.channels.size() == 1) != (type->type == PixelType::bits32))
        return std::nullopt;
    if (type->type != PixelType::bits32) {
        const std::vector<std::vector<std::string>> of_light{
            {"R", "G", "B", "A"}, {"R", "G", "B"}, {"Y", "A"}};
        const auto wanted = std::ranges::find_if(of_light, [&](std::vector<std::string> names) {
            std::ranges::sort(names);
            return names == header.channels;
        });
        if (wanted == of_light.end())
            return std::nullopt;
        header.channels = *wanted;
        header.alpha_channel = header.channel("A");
    }
    header.type = type->type;
    header.type_name = type->name;
    header.format = "openexr";
    if (Imf::hasChromaticities(stored)) {
        const Imf::Chromaticities& colours = Imf::chromaticities(stored);
        auto* number = header.primaries.emplace().data();
        for (const Imath::V2f& xy : {colours.red, colours.green, colours.blue, colours.white}) {
            *number++ = static_cast<double>(xy.x);
            *number++ = static_cast<double>(xy.y);
        }
    }
    header.attributes.emplace_back("compression", std::string(compression->name));
    for (auto attribute = stored.begin(); attribute != stored.end(); ++attribute)
        read_attribute(attribute.name(), attribute.attribute(), header);
    return header;
}

class PlainExrDecoder final : public PictureDecoder {
  public:
    PlainExrDecoder(std::string file, std::unique_ptr<Imf::InputFile> input, PictureHeader header)
        : file_(std::move(file)), input_(std::move(input)), header_(std::move(header)) {}
    const PictureHeader& header() const override { return header_; }
    std::string read(int begin_row, int end_row, int channels, PixelType as, void* into) override {
        const StoredType* const wanted = stored_as(as == PixelType::other ? header_.type : as);
        // Whole numbers and floats are not taken for one another here.
        if (wanted && (wanted->type == PixelType::bits32) == (header_.type == PixelType::bits32)) {
            try {
                read_plain(begin_row, end_row, channels, *wanted, static_cast<char*>(into));
                return {};
            } catch (const std::exception&) {
                // Said by OpenImageIO, as of any other file.
            }
        }
        std::string fault;
        const auto decoder = picture_library().open(file_, false, fault);
        return decoder ? decoder->read(begin_row, end_row, channels, as, into) : fault;
    }

  private:
    void read_plain(int begin_row, int end_row, int channels, const StoredType& as, char* into) {
        const std::size_t pixel_bytes = static_cast<std::size_t>(channels) * as.bytes,
                          row_bytes = pixel_bytes * static_cast<std::size_t>(header_.size_px.x);
        // A slice counts rows from the picture's first.
        char* const first = into - static_cast<std::ptrdiff_t>(row_bytes) * begin_row;
        Imf::FrameBuffer rows;
        for (int channel = 0; channel < channels; ++channel)
            rows.insert(header_.channels[static_cast<std::size_t>(channel)],
                        Imf::Slice(as.stored, first + static_cast<std::size_t>(channel) * as.bytes,
                                   pixel_bytes, row_bytes));
        input_->setFrameBuffer(rows);
        input_->readPixels(begin_row, end_row - 1);
    }

    std::string file_;
    std::unique_ptr<Imf::InputFile> input_;
    PictureHeader header_;
};

/// Nothing if a file with this header is left to OpenImageIO.
std::optional<Imf::Header> stored_header_of(const PictureHeader& header, const StoredType& type) {
    Imf::Header stored(header.size_px.x, header.size_px.y);
    for (const std::string& channel : header.channels)
        stored.channels().insert(channel, Imf::Channel(type.stored));
    stored.compression() = Imf::ZIP_COMPRESSION;
    // OpenImageIO would write the time of day: the same picture shall have the same bytes.
    stored.insert("capDate", Imf::StringAttribute("1970:01:01 00:00:00"));
    for (const auto& [name, value] : header.attributes) {
        if (name == "compression") {
            const auto* const wanted =
                std::ranges::find(compressions, header.text(name), [](const auto& row) { return row.name; });
            if (wanted == std::end(compressions))
                return std::nullopt;
            stored.compression() = wanted->stored;
        } else if (!name.starts_with("overt:")) {
            return std::nullopt;
        } else if (const auto* const number = std::get_if<int>(&value)) {
            stored.insert(name, Imf::IntAttribute(*number));
        } else if (const auto* const real = std::get_if<double>(&value)) {
            stored.insert(name, Imf::DoubleAttribute(*real));
        } else if (const auto* const triple = std::get_if<glm::dvec3>(&value)) {
            stored.insert(name, Imf::V3dAttribute(Imath::V3d(triple->x, triple->y, triple->z)));
        } else {
            stored.insert(name, Imf::StringAttribute(std::get<std::string>(value)));
        }
    }
    return stored;
}

/// Into memory: when a disk fills up, the library does not always say so.
class MemoryStream final : public Imf::OStream {
  public:
    MemoryStream() : OStream("memory") {}
    void write(const char bytes[], int count) override {
        const std::size_t end = place_ + static_cast<std::size_t>(count);
        if (end > bytes_.size())
            bytes_.resize(end);
        std::copy_n(bytes, count, bytes_.begin() + static_cast<std::ptrdiff_t>(place_));
        place_ = end;
    }
    std::uint64_t tellp() override { return place_; }
    void seekp(std::uint64_t place) override { place_ = place; }
    std::vector<unsigned char> take() { return std::move(bytes_); }

  private:
    std::vector<unsigned char> bytes_;
    std::size_t place_ = 0;
};

} // namespace

std::optional<std::vector<unsigned char>> encode_plain_exr(const PictureHeader& header, PixelType type,
                                                           const void* pixels) {
    const StoredType *const stored = stored_as(header.type), *const given = stored_as(type);
    if (!stored || !given || (stored->type == PixelType::bits32) != (given->type == PixelType::bits32) ||
        (stored->type == PixelType::float32 && given->type == PixelType::float16))
        return std::nullopt;
    const std::optional<Imf::Header> stored_header = stored_header_of(header, *stored);
    if (!stored_header)
        return std::nullopt;
    const std::size_t count = header.channels.size() * static_cast<std::size_t>(header.size_px.x) *
                              static_cast<std::size_t>(header.size_px.y);
    std::vector<half> halves;
    const auto* bytes = static_cast<const char*>(pixels);
    if (stored->type != given->type) {
        const auto* const values = static_cast<const float*>(pixels);
        halves.assign(values, values + count);
        bytes = reinterpret_cast<const char*>(halves.data());
    }
    Imf::FrameBuffer rows;
    const std::size_t pixel_bytes = header.channels.size() * stored->bytes;
    for (std::size_t channel = 0; channel < header.channels.size(); ++channel)
        // The library writes from what it takes as changeable.
        rows.insert(header.channels[channel],
                    Imf::Slice(stored->stored, const_cast<char*>(bytes) + channel * stored->bytes,
                               pixel_bytes, pixel_bytes * static_cast<std::size_t>(header.size_px.x)));
    MemoryStream stream;
    try {
        Imf::OutputFile output(stream, *stored_header, 0);
        output.setFrameBuffer(rows);
        output.writePixels(header.size_px.y);
        // At its end it goes back and writes where the rows are.
    } catch (const std::exception&) {
        return std::nullopt;
    }
    return stream.take();
}

std::unique_ptr<PictureDecoder> open_plain_exr(const std::string& file) {
    if (!file.ends_with(".exr"))
        return nullptr;
    try {
        // Before anything is made for what a damaged header claims. Of the whole library, so once.
        [[maybe_unused]] static const bool is_bounded = [] {
            Imf::Header::setMaxImageSize(most_picture_side_px, most_picture_side_px);
            return true;
        }();
        bool is_tiled = false, is_deep = false, has_parts = false;
        if (!Imf::isOpenExrFile(file.c_str(), is_tiled, is_deep, has_parts) || is_tiled || is_deep ||
            has_parts)
            return nullptr;
        auto input = std::make_unique<Imf::InputFile>(file.c_str(), 0);
        auto header = plain_header_of(input->header());
        return header ? std::make_unique<PlainExrDecoder>(file, std::move(input), std::move(*header))
                      : nullptr;
    } catch (const std::exception&) {
        return nullptr;
    }
}

} // namespace overt
