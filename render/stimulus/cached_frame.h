/// Rendered frames on disk that say whose they are, and what their pixels are. A cache is a folder like any
/// other: files in it may be swapped, cut off, or come from another lab.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiment/base/content_hash.h"
#include "experiment/object_pose.h"
#include "render/image/linear_image.h"

namespace overt {

/// What a frame is of.
struct FrameIdentity {
    ContentHash key; ///< of everything that makes it but how the object stands: StimulusCache::picture_key
    ObjectPose object;
};

/// SHA-256 of a picture's size and of its values as a file of 24 bits keeps them (PXR24), little-endian, row
/// by row: the same of a picture that is about to be written and of one that was read back.
ContentHash hash_of_pixels(const LinearImage& image);

/// Tilt and shift of an object that is not only turned about the vertical, as frames and maps say it; else
/// empty.
std::string text_of_move(const ObjectPose& object);

/// Adds how the object stands to a hash. An object that is only turned counts as it did when there were turns
/// alone.
void add_object(ContentHasher& hasher, const ObjectPose& object);

/// The attribute of a file that holds it, where it is not empty.
inline constexpr const char* const move_attribute = "overt:tilt_and_shift";

/// Writes a frame with its identity and the hash of its pixels, whole or not at all. Throws RecordError.
void write_cached_frame(const std::filesystem::path& file, const LinearImage& image,
                        const FrameIdentity& identity, ImageAttributes attributes);

/// What makes a file no frame of that identity, as the end of a sentence that begins with its name: "is not
/// whole", "is another frame". Nothing: it is one, as far as its header tells. A file of an earlier program
/// may say no key, where `must_say_all` is false.
std::optional<std::string> why_no_frame(const std::filesystem::path& file, const FrameIdentity& identity,
                                        bool must_say_all);

/// The hash of a frame's pixels, as its file says it. A file of an earlier program, which does not, is read
/// and written again with it, where it can be. Throws InputError.
ContentHash pixels_hash_of(const std::filesystem::path& file, const FrameIdentity& identity);

/// Reads a frame, and compares identity and pixels with what its file says. Throws InputError naming the file
/// and what to do.
void read_cached_frame(const std::filesystem::path& file, const FrameIdentity& identity, LinearImage& into);

/// What OpenGL said of its renderer when it drew the frame; empty for others.
std::string renderer_of_frame(const std::filesystem::path& file);

} // namespace overt
