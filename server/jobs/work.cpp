#include "server/jobs/work.h"

#include <utility>
#include <vector>

#include "core/optimize/compare.h"
#include "core/optimize/inspect.h"
#include "core/optimize/optimize.h"
#include "proto/comparison.h"
#include "proto/report.h"

namespace coppice {
namespace {

// The files of a job, and the bytes that the upload's views look at.
struct LoadedUpload {
    std::vector<Bytes> bytes;
    Upload upload;
};

LoadedUpload load(const StoredFile& asset, const std::vector<StoredFile>& resources, const BlobStore& blobs,
                  const Watch& watch) {
    LoadedUpload loaded;
    loaded.bytes.reserve(resources.size() + 1);  // views stay valid
    const auto load_file = [&](const StoredFile& file) {
        watch.check();
        loaded.bytes.push_back(load_blob(blobs, {file.sha256, file.bytes}));
        return UploadedFile{file.path, file.media_type, loaded.bytes.back()};
    };
    loaded.upload.asset = load_file(asset);
    for (const StoredFile& resource : resources) loaded.upload.resources.push_back(load_file(resource));
    return loaded;
}

uint64_t bytes_of(const JobRecord& record) {
    uint64_t bytes = 0;
    for (const StoredFile* file : record.input_files()) bytes += file->bytes;
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

// A job whose result is a document: what `print` returns, and how long it took.
template <typename Print>
Worked document(const JobRecord& record, BlobStore& blobs, Print print) {
    const auto begin = std::chrono::steady_clock::now();
    const std::string text = print();
    Worked worked;
    worked.result.file =
        store_bytes(worked, blobs, as_bytes(text), stem_of(record.asset.path) + ".json", "application/json");
    worked.result.report = worked.result.file;
    const std::chrono::duration<double, std::milli> total = std::chrono::steady_clock::now() - begin;
    worked.result.stage_ms = {{"total", total.count()}};
    return worked;
}

Worked inspect_upload(const JobRecord& record, const Upload& upload, BlobStore& blobs,
                      const ReadLimits& limits, const Watch& watch) {
    return document(record, blobs, [&] { return print_inspection(inspect(upload, limits, watch)); });
}

Worked compare_uploads(const JobRecord& record, const Upload& reference, BlobStore& blobs,
                       const ReadLimits& limits, unsigned threads, const Watch& watch) {
    const StoredUpload& stored = record.candidate.value();
    const LoadedUpload candidate = load(stored.asset, stored.resources, blobs, watch);
    CompareOptions options = record.job.comparison;
    options.threads = threads;
    return document(record, blobs, [&] {
        return print_comparison(compare(reference, candidate.upload, options, limits, watch));
    });
}

Worked work_on(const JobRecord& record, const Upload& upload, BlobStore& blobs, const ReadLimits& limits,
               unsigned threads, const Watch& watch) {
    switch (record.job.kind) {
        case JobKind::optimize:
            return optimize_upload(record, upload, blobs, limits, threads, watch);
        case JobKind::inspect:
            return inspect_upload(record, upload, blobs, limits, watch);
        case JobKind::compare:
            return compare_uploads(record, upload, blobs, limits, threads, watch);
    }
    return {};
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
    LoadedUpload loaded = load(record.asset, record.resources, blobs, watch);
    loaded.upload.entry = record.job.options.entry;
    Worked worked = work_on(record, loaded.upload, blobs, limits, threads, watch);
    worked.result.bytes_in = bytes_of(record);
    return worked;
}

}  // namespace coppice
