#include "server/jobs/work.h"

#include <utility>
#include <vector>

#include "core/optimize/inspect.h"
#include "core/optimize/optimize.h"
#include "proto/report.h"

namespace coppice {
namespace {

// The files of a job, and the bytes that the upload's views look at.
struct LoadedUpload {
    std::vector<Bytes> bytes;
    Upload upload;
};

LoadedUpload load(const JobRecord& record, const BlobStore& blobs, const Watch& watch) {
    LoadedUpload loaded;
    loaded.bytes.reserve(record.resources.size() + 1);  // views stay valid
    const auto load_file = [&](const StoredFile& file) {
        watch.check();
        loaded.bytes.push_back(load_blob(blobs, {file.sha256, file.bytes}));
        return UploadedFile{file.path, file.media_type, loaded.bytes.back()};
    };
    loaded.upload.asset = load_file(record.asset);
    for (const StoredFile& resource : record.resources)
        loaded.upload.resources.push_back(load_file(resource));
    loaded.upload.entry = record.job.options.entry;
    return loaded;
}

uint64_t bytes_of(const JobRecord& record) {
    uint64_t bytes = record.asset.bytes;
    for (const StoredFile& resource : record.resources) bytes += resource.bytes;
    return bytes;
}

// "models/tree.zip" -> "tree"
std::string stem_of(const std::string& path) {
    std::string name = path.substr(path.find_last_of("/\\") + 1);
    name.resize(std::min(name.size(), name.find_last_of('.')));
    return name.empty() ? "scene" : name;
}

Worked optimize_upload(const JobRecord& record, const Upload& upload, BlobStore& blobs,
                       const ReadLimits& limits, unsigned threads, const Watch& watch) {
    OptimizeOptions options = record.job.options;
    options.threads = threads;
    Optimized optimized = optimize(upload, options, limits, watch);
    Report& report = optimized.report;
    if (record.job.started_at) {
        report.timing_ms.queue =
            static_cast<double>((*record.job.started_at - record.job.created_at).count());
    }
    Worked worked;
    const WrittenAsset& asset = optimized.asset;
    worked.result.file =
        store_bytes(worked, blobs, asset.bytes, stem_of(record.asset.path) + "." + asset.file_extension,
                    asset.media_type);
    worked.result.report =
        store_bytes(worked, blobs, as_bytes(print_report(report)), "report.json", "application/json");
    worked.result.triangles_in = report.input.unique_triangles;
    worked.result.triangles_out = report.output.unique_triangles;
    const StageTimes& times = report.timing_ms;
    worked.result.stage_ms = {{"read", times.read},         {"discover", times.discover},
                              {"simplify", times.simplify}, {"encode", times.encode},
                              {"write", times.write},       {"total", times.total},
                              {"queue", times.queue}};
    return worked;
}

Worked inspect_upload(const JobRecord& record, const Upload& upload, BlobStore& blobs,
                      const ReadLimits& limits, const Watch& watch) {
    const auto begin = std::chrono::steady_clock::now();
    const std::string inspection = print_inspection(inspect(upload, limits, watch));
    Worked worked;
    worked.result.file = store_bytes(worked, blobs, as_bytes(inspection),
                                     stem_of(record.asset.path) + ".json", "application/json");
    worked.result.report = worked.result.file;
    const std::chrono::duration<double, std::milli> total = std::chrono::steady_clock::now() - begin;
    worked.result.stage_ms = {{"total", total.count()}};
    return worked;
}

}  // namespace

StoredFile store_bytes(Worked& worked, BlobStore& blobs, ByteView bytes, std::string file_name,
                       std::string media_type) {
    auto writer = blobs.create();
    writer->write(bytes);
    const BlobRef blob = writer->commit();
    worked.holds.push_back(std::move(writer));
    return {std::move(file_name), std::move(media_type), blob.sha256, blob.bytes};
}

Worked work(const JobRecord& record, BlobStore& blobs, const ReadLimits& limits, unsigned threads,
            const Watch& watch) {
    const LoadedUpload loaded = load(record, blobs, watch);
    Worked worked = record.job.kind == JobKind::optimize
                        ? optimize_upload(record, loaded.upload, blobs, limits, threads, watch)
                        : inspect_upload(record, loaded.upload, blobs, limits, watch);
    worked.result.bytes_in = bytes_of(record);
    return worked;
}

}  // namespace coppice
