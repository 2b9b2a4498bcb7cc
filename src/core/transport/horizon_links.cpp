#include "transport/horizon_links.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>

#include "base/parallel.h"
#include "transport/link_replay.h"

namespace heightlight {
namespace {

/// What a thread needs to go from tile to tile.
struct Workspace {
  WalkTile tile;
  std::vector<std::uint8_t> stream;
};

}  // namespace

HorizonLinks::HorizonLinks(const Surface& surface, const HeightMips& mips, const WalkOptions& options,
                           std::vector<BlockSet> blocks, const LinkLimits& limits)
    : surface_(surface),
      mips_(mips),
      options_(options),
      azimuths_(make_link_azimuths(surface, options)),
      rings_(ring_count(surface, options)),
      tiles_(surface.width(), surface.height()),
      blocks_(std::move(blocks)),
      light_(surface),
      gather_watch_{.tell = {}, .stopped = limits.watch.stopped},
      streams_(static_cast<std::size_t>(tiles_.count())) {
  std::vector<std::unique_ptr<Workspace>> workspaces(static_cast<std::size_t>(thread_count()));
  std::atomic<std::uint64_t> taken{0};
  Progress progress("links", tiles_.count(), limits.watch);
  parallel_for(
      tiles_.count(),
      [&](std::int64_t i) {
        const BlockSet& wanted = blocks_[static_cast<std::size_t>(i)];
        if (wanted.none() || taken.load(std::memory_order_relaxed) >= limits.memory) return;
        std::unique_ptr<Workspace>& work = workspaces[static_cast<std::size_t>(omp_get_thread_num())];
        if (!work) work = std::make_unique<Workspace>();
        work->tile.load(surface_, mips_, options_, rings_, tiles_.frame(i));
        work->stream.clear();
        walk_links(work->tile, azimuths_, wanted, work->stream);
        const std::uint64_t size = work->stream.size();
        if (taken.fetch_add(size) + size <= limits.memory)
          streams_[static_cast<std::size_t>(i)] = work->stream;
      },
      &progress);
}

void HorizonLinks::mean_seen(const TexelVector& x, Image<float>& mean) {
  light_.fill(x);
  std::vector<std::unique_ptr<Workspace>> workspaces(static_cast<std::size_t>(thread_count()));
  Progress progress("gather", tiles_.count(), gather_watch_);
  parallel_for(
      tiles_.count(),
      [&](std::int64_t i) {
        const BlockSet& wanted = blocks_[static_cast<std::size_t>(i)];
        if (wanted.none()) return;
        const TileFrame frame = tiles_.frame(i);
        const std::vector<std::uint8_t>* stream = &streams_[static_cast<std::size_t>(i)];
        if (stream->empty()) {
          std::unique_ptr<Workspace>& work = workspaces[static_cast<std::size_t>(omp_get_thread_num())];
          if (!work) work = std::make_unique<Workspace>();
          work->tile.load(surface_, mips_, options_, rings_, frame);
          work->stream.clear();
          walk_links(work->tile, azimuths_, wanted, work->stream);
          stream = &work->stream;
        }
        std::array<float, WalkTile::kTexels> seen;
        replay_links(frame, azimuths_, wanted, stream->data(), light_, seen.data());
        for (int row = 0; row < frame.rows; ++row) {
          for (int column = 0; column < frame.columns; column += kBlock) {
            if (!wanted[block_index(row, column)]) continue;
            std::copy_n(seen.data() + std::ptrdiff_t{row} * TileFrame::kSide + column,
                        std::min(kBlock, frame.columns - column),
                        &mean(frame.first_row + row, frame.first_column + column));
          }
        }
      },
      &progress);
}

std::uint64_t HorizonLinks::entries() const {
  std::uint64_t bytes = 0;
  for (std::int64_t i = 0; i < tiles_.count(); ++i) {
    const std::vector<std::uint8_t>& stream = streams_[static_cast<std::size_t>(i)];
    if (stream.empty()) continue;
    bytes += stream.size() - blocks_[static_cast<std::size_t>(i)].count() * azimuths_.size() * kCountBytes;
  }
  return bytes / kEntryBytes;
}

std::uint64_t HorizonLinks::bytes() const {
  std::uint64_t bytes = 0;
  for (const std::vector<std::uint8_t>& stream : streams_) bytes += stream.size();
  return bytes;
}

double HorizonLinks::kept_share() const {
  const auto kept = std::count_if(streams_.begin(), streams_.end(),
                                  [](const std::vector<std::uint8_t>& stream) { return !stream.empty(); });
  const auto wanted =
      std::count_if(blocks_.begin(), blocks_.end(), [](const BlockSet& blocks) { return blocks.any(); });
  return wanted > 0 ? static_cast<double>(kept) / static_cast<double>(wanted) : 1;
}

}  // namespace heightlight
