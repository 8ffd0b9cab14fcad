#include <algorithm>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "experiment/pictures/picture_library.h"

namespace overt {

namespace {

using OIIO::TypeDesc;

constexpr TypeDesc double_triple(TypeDesc::DOUBLE, TypeDesc::VEC3);

constexpr std::pair<PixelType, TypeDesc::BASETYPE> types[] = {
    {PixelType::bits8, TypeDesc::UINT8},   {PixelType::bits16, TypeDesc::UINT16},
    {PixelType::bits32, TypeDesc::UINT32}, {PixelType::float16, TypeDesc::HALF},
    {PixelType::float32, TypeDesc::FLOAT}, {PixelType::other, TypeDesc::UNKNOWN}};

TypeDesc type_desc(PixelType type) {
    return std::ranges::find(types, type, [](const auto& row) { return row.first; })->second;
}

PixelType value_type(const TypeDesc& type) {
    const auto* const row = std::ranges::find(types, TypeDesc::BASETYPE(type.basetype),
                                              [](const auto& pair) { return pair.second; });
    return row == std::end(types) ? PixelType::other : row->first;
}

void read_attribute(const OIIO::ParamValue& attribute, PictureHeader& into) {
    const std::string name = attribute.name().string();
    const TypeDesc type = attribute.type();
    if (type == TypeDesc(TypeDesc::STRING)) {
        into.attributes.emplace_back(name, attribute.get_string());
    } else if (type == TypeDesc(TypeDesc::INT)) {
        into.attributes.emplace_back(name, *static_cast<const int*>(attribute.data()));
    } else if (type == TypeDesc(TypeDesc::DOUBLE)) {
        into.attributes.emplace_back(name, *static_cast<const double*>(attribute.data()));
    } else if (type.basetype == TypeDesc::DOUBLE && type.basevalues() == 3) {
        // Whether it calls itself a vector or three numbers does not matter.
        const auto* const values = static_cast<const double*>(attribute.data());
        into.attributes.emplace_back(name, glm::dvec3(values[0], values[1], values[2]));
    }
}

void write_attribute(OIIO::ImageSpec& spec, const std::string& name, const PictureAttribute& attribute) {
    if (const auto* const number = std::get_if<int>(&attribute))
        spec.attribute(name, *number);
    else if (const auto* const real = std::get_if<double>(&attribute))
        spec.attribute(name, TypeDesc::DOUBLE, real);
    else if (const auto* const triple = std::get_if<glm::dvec3>(&attribute))
        spec.attribute(name, double_triple, &triple->x);
    else
        spec.attribute(name, std::get<std::string>(attribute));
}

PictureHeader header_of(const OIIO::ImageSpec& spec) {
    PictureHeader header{
        {spec.width, spec.height}, spec.channelnames, value_type(spec.format), spec.alpha_channel};
    header.channels.resize(static_cast<std::size_t>(std::max(spec.nchannels, 0)));
    for (const OIIO::ParamValue& attribute : spec.extra_attribs)
        read_attribute(attribute, header);
    header.type_name = spec.format.c_str();
    header.tile_px = {spec.tile_width, spec.tile_height};
    header.channels_differ = !spec.channelformats.empty();
    header.is_deep_or_volume = spec.deep || spec.depth > 1;
    return header;
}

class OiioDecoder final : public PictureDecoder {
  public:
    explicit OiioDecoder(std::unique_ptr<OIIO::ImageInput> input)
        : input_(std::move(input)), header_(header_of(input_->spec())) {
        // Each file is read by one thread: several are read at once.
        input_->threads(1);
    }
    const PictureHeader& header() const override { return header_; }
    std::string read(int begin_row, int end_row, int channels, PixelType as, void* into) override {
        const bool all = begin_row == 0 && end_row == header_.size_px.y;
        const int top = input_->spec().y;
        const bool was_read =
            all ? input_->read_image(0, 0, 0, channels, type_desc(as), into)
                : input_->read_scanlines(0, 0, top + begin_row, top + end_row, input_->spec().z, 0, channels,
                                         type_desc(as), into);
        return was_read ? std::string() : input_->geterror();
    }

  private:
    std::unique_ptr<OIIO::ImageInput> input_;
    PictureHeader header_;
};

class OiioLibrary final : public PictureLibrary {
  public:
    std::unique_ptr<PictureDecoder> open(const std::string& file, bool straight,
                                         std::string& fault) const override {
        OIIO::ImageSpec wish;
        if (straight)
            wish.attribute("oiio:UnassociatedAlpha", 1);
        if (auto input = OIIO::ImageInput::open(file, &wish))
            return std::make_unique<OiioDecoder>(std::move(input));
        fault = OIIO::geterror();
        return nullptr;
    }
    std::string encode(const std::string& name, const PictureHeader& header, PixelType type,
                       const void* pixels, std::vector<unsigned char>& bytes) const override {
        OIIO::ImageSpec spec(header.size_px.x, header.size_px.y, header.channel_count(),
                             type_desc(header.type));
        spec.channelnames = header.channels;
        spec.alpha_channel = header.alpha_channel;
        for (const auto& [key, value] : header.attributes)
            write_attribute(spec, key, value);
        // OpenImageIO would write the time of day into an EXR file: the same picture shall have the same
        // bytes.
        if (name.ends_with(".exr") && !header.attribute<std::string>("DateTime"))
            spec.attribute("DateTime", "1970:01:01 00:00:00");
        // Into memory: when a disk fills up, libraries of picture formats do not always say so.
        OIIO::Filesystem::IOVecOutput memory;
        const auto output = OIIO::ImageOutput::create(name);
        if (!output || !output->set_ioproxy(&memory) || !output->open(name, spec) ||
            !output->write_image(type_desc(type), pixels) || !output->close())
            return output ? output->geterror() : OIIO::geterror();
        bytes = memory.buffer();
        return {};
    }
};

} // namespace

} // namespace overt

extern "C" __attribute__((visibility("default"))) const overt::PictureLibrary* overt_picture_library() {
    static const overt::OiioLibrary library;
    return &library;
}
