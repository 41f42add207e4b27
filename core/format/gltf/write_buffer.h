// The one buffer of a written file, and the accessors and buffer views into it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/format/gltf/accessor.h"
#include "core/format/gltf/json_text.h"

namespace coppice::gltf {

// Elements of a kind share a buffer view each, so that a scene of many meshes needs few of them.
class BufferWriter {
  public:
    // Keeps a reference to the watch.
    explicit BufferWriter(const Watch& watch) : watch_(watch) {}

    // Views and accessors with which the arrays begin: they keep their indices.
    void keep(const Json& accessors, const Json& views, const std::map<uint32_t, Bytes>& bytes);

    // What an accessor is for decides which view it goes to.
    enum class Kind : uint8_t { vertices, indices, inverse_bind, data };

    // values: count elements, tightly packed. Returns the accessor's index. bounds: with min and max.
    uint32_t add(const Accessor& accessor, Kind kind, bool bounds, const Json& more = Json::object());

    // An accessor without a buffer view, as it was.
    uint32_t add_without_data(const Json& accessor);

    // Bytes of their own: an image.
    uint32_t add_view(ByteView bytes);

    uint64_t size() const { return size_; }

    // Moves the arrays into the document ("buffers" without uri) and gives the bytes.
    Bytes finish(Json& document);

  private:
    struct View {
        Bytes bytes;
        Json json = Json::object();
    };
    uint32_t shared_view(Kind kind, uint32_t stride);

    const Watch& watch_;
    std::vector<View> views_;
    std::map<std::pair<Kind, uint32_t>, uint32_t> shared_;  // by kind and stride
    Json accessors_ = Json::array();
    uint64_t size_ = 0;  // bytes so far
};

// The shortest decimal that gives the same float: JSON of it is not longer than needed.
double shortest(float value);

}  // namespace coppice::gltf
