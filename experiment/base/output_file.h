/// A file that is written once, from its beginning to its end, in large pieces; packed if wanted.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace overt {

enum class Packing : std::uint8_t {
    none,
    /// With neither a name nor a time in its header: the same content gives the same bytes.
    gzip,
};

/// Not for use from several threads at once.
class OutputFile {
  public:
    /// Makes the file, which must not be there. Throws RecordError.
    explicit OutputFile(const std::filesystem::path& path, Packing packing = Packing::none);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// To be added to; call flush_if_full() now and then.
    std::string& text() { return text_; }

    /// Brings the text to the file once there is enough of it. Throws RecordError.
    void flush_if_full() {
        if (text_.size() >= piece_bytes)
            flush();
    }

    /// Of content, before packing, including what is not yet in the file.
    std::int64_t size() const { return flushed_ + static_cast<std::int64_t>(text_.size()); }

    /// Brings the rest to the file. Throws RecordError. Nothing may be added afterwards.
    void close();

  private:
    static constexpr std::size_t piece_bytes = std::size_t{1} << 18;
    void flush();
    void write(std::string_view bytes);

    struct Packer;
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::unique_ptr<Packer> packer_; ///< null: not packed
    std::string text_;
    std::int64_t flushed_ = 0;
};

/// Writes a small file at once. It must not be there. Throws RecordError.
void write_text_file(const std::filesystem::path& path, std::string_view text);

} // namespace overt
