#include "core/format/gltf/write_buffer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/watched_loop.h"

namespace coppice::gltf {

namespace {

const char* type_name(const Accessor& accessor) {
    if (accessor.columns > 1) return accessor.columns == 2 ? "MAT2" : accessor.columns == 3 ? "MAT3" : "MAT4";
    constexpr const char* names[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    return names[accessor.rows - 1];
}

Json number(double value, ComponentType type) {
    if (type == ComponentType::float32) return shortest(static_cast<float>(value));
    return static_cast<int64_t>(value);
}

void add_bounds(const Accessor& accessor, Json& json) {
    json["min"] = Json::array();
    json["max"] = Json::array();
    for (uint32_t c = 0; c < accessor.components(); ++c) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        accessor.for_each_raw(0, accessor.count, c, [&](double value) {
            low = std::min(low, value);
            high = std::max(high, value);
        });
        json["min"].push_back(number(low, accessor.storage.type));
        json["max"].push_back(number(high, accessor.storage.type));
    }
}

void pad(Bytes& bytes, size_t to) {
    bytes.resize((bytes.size() + to - 1) / to * to);
}

}  // namespace

double shortest(float value) {
    if (value == 0) return 0;  // -0 too
    std::array<char, 64> text{};
    const auto printed = std::to_chars(text.data(), text.data() + text.size(), value);
    double result = 0;
    std::from_chars(text.data(), printed.ptr, result);
    return result;
}

void BufferWriter::keep(const Json& accessors, const Json& views, const std::map<uint32_t, Bytes>& bytes) {
    accessors_ = accessors;
    for (uint32_t i = 0; i < views.size(); ++i) {
        View view{bytes.at(i), views[i]};
        if (view.json.contains("extensions")) {
            view.json["extensions"].erase("EXT_meshopt_compression");
            if (view.json["extensions"].empty()) view.json.erase("extensions");
        }
        size_ += view.bytes.size();
        views_.push_back(std::move(view));
    }
}

uint32_t BufferWriter::shared_view(Kind kind, uint32_t stride) {
    const auto [found, is_new] = shared_.try_emplace({kind, stride}, static_cast<uint32_t>(views_.size()));
    if (is_new) {
        View view;
        if (kind == Kind::vertices) view.json = {{"target", 34962}, {"byteStride", stride}};
        if (kind == Kind::indices) view.json = {{"target", 34963}};
        views_.push_back(std::move(view));
    }
    return found->second;
}

uint32_t BufferWriter::add(const Accessor& accessor, Kind kind, bool bounds, const Json& more) {
    const uint32_t tight = accessor.tight_stride();
    const uint32_t stride = kind == Kind::vertices ? (tight + 3) / 4 * 4 : tight;
    // Indices of a width and data of a kind share a view; vertices share it by stride.
    const uint32_t view_index = shared_view(kind, kind == Kind::data ? 0 : stride);
    Bytes& bytes = views_[view_index].bytes;
    const size_t before = bytes.size();
    pad(bytes, 4);
    Json json = more;
    json["bufferView"] = view_index;
    if (!bytes.empty()) json["byteOffset"] = bytes.size();
    json["componentType"] = static_cast<int>(accessor.storage.type);
    if (accessor.storage.normalized) json["normalized"] = true;
    json["count"] = accessor.count;
    json["type"] = type_name(accessor);
    watched_loop(accessor.count, watch_, [&](size_t i) {
        append(bytes,
               accessor.bytes.subspan(i * accessor.stride,
                                      std::min<size_t>(tight, accessor.bytes.size() - i * accessor.stride)));
        bytes.resize(bytes.size() + (stride - tight));
    });
    if (bounds) add_bounds(accessor, json);
    size_ += bytes.size() - before;
    accessors_.push_back(std::move(json));
    return static_cast<uint32_t>(accessors_.size() - 1);
}

uint32_t BufferWriter::add_without_data(const Json& accessor) {
    accessors_.push_back(accessor);
    return static_cast<uint32_t>(accessors_.size() - 1);
}

uint32_t BufferWriter::add_view(ByteView bytes) {
    views_.push_back({Bytes(bytes.begin(), bytes.end()), Json::object()});
    size_ += bytes.size();
    return static_cast<uint32_t>(views_.size() - 1);
}

Bytes BufferWriter::finish(Json& document) {
    Bytes all;
    Json views = Json::array();
    all.reserve(size_ + 8 * views_.size());
    for (View& view : views_) {
        pad(all, 8);  // what metadata asks for; others are content with 4
        view.json["buffer"] = 0;
        view.json.erase("byteOffset");
        if (!all.empty()) view.json["byteOffset"] = all.size();
        view.json["byteLength"] = view.bytes.size();
        watched_append(all, view.bytes, watch_);
        view.bytes = {};
        views.push_back(std::move(view.json));
    }
    for (const char* part : {"accessors", "bufferViews", "buffers"}) document.erase(part);
    if (!accessors_.empty()) document["accessors"] = std::move(accessors_);
    if (!views.empty()) document["bufferViews"] = std::move(views);
    if (!all.empty()) document["buffers"] = Json::array({{{"byteLength", all.size()}}});
    return all;
}

}  // namespace coppice::gltf
