// SPDX-License-Identifier: Apache-2.0
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_run_length_encode.cuh>

#include "solver/device/gpus.hpp"
#include "solver/device/launch.cuh"
#include "solver/device/open_device.cuh"
#include "solver/device/toolkits.hpp"

namespace scree {
inline namespace cuda {
namespace {

/// For runs_kernels().
__global__ void probe() {}

/// The current GPU; all work goes to its default stream, in order.
class CudaDevice final : public Device {
 public:
  explicit CudaDevice(std::string name) : name_(std::move(name)) {
    check(cudaMalloc(&runs_, sizeof(std::int64_t)), "allocating memory");
  }
  ~CudaDevice() override {
    release(room_);
    release(spare_keys_);
    release(spare_values_);
    release(runs_);
  }

  std::string name() const override { return name_; }
  std::size_t free_memory() const override {
    std::size_t free = 0;
    std::size_t total = 0;
    check(cudaMemGetInfo(&free, &total), "asking for free memory");
    return free;
  }
  void* allocate(std::size_t bytes, const char* what) override {
    void* p = nullptr;
    const cudaError_t error = cudaMalloc(&p, bytes);
    if (error == cudaErrorMemoryAllocation) {
      (void)cudaGetLastError();
      throw RunFault("the GPU has no room for another " + std::to_string(bytes >> 20) + " MB for " +
                     what + "; use fewer particles or --backend cpu");
    }
    check(error, "allocating memory");
    return p;
  }
  void release(void* p) noexcept override { (void)cudaFree(p); }
  void upload(void* to, const void* from, std::size_t bytes) override {
    check(cudaMemcpy(to, from, bytes, cudaMemcpyHostToDevice), "copying to the GPU");
  }
  void download(void* to, const void* from, std::size_t bytes) override {
    check(cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToHost), "a step, or copying its results");
  }
  void copy(void* to, const void* from, std::size_t bytes) override {
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToDevice), "copying on the GPU");
  }
  void zero(void* to, std::size_t bytes) override {
    check(cudaMemsetAsync(to, 0, bytes), "clearing memory");
  }
  void wait() override { check(cudaDeviceSynchronize(), "waiting for the GPU"); }

  void sort(std::uint64_t* keys, std::int32_t* values, std::int64_t count) override {
    const auto n = static_cast<std::size_t>(count);
    grow(spare_keys_, spare_keys_bytes_, n * sizeof *keys);
    grow(spare_values_, spare_values_bytes_, n * sizeof *values);
    cub::DoubleBuffer<std::uint64_t> k(keys, static_cast<std::uint64_t*>(spare_keys_));
    cub::DoubleBuffer<std::int32_t> v(values, static_cast<std::int32_t*>(spare_values_));
    std::size_t room = 0;
    check(cub::DeviceRadixSort::SortPairs(nullptr, room, k, v, count), "sorting");
    grow(room_, room_bytes_, room);
    check(cub::DeviceRadixSort::SortPairs(room_, room, k, v, count), "sorting");
    if (k.Current() != keys) copy(keys, k.Current(), n * sizeof *keys);
    if (v.Current() != values) copy(values, v.Current(), n * sizeof *values);
  }

  std::int64_t find_runs(const std::uint64_t* keys, std::int64_t count, std::uint64_t* different,
                         std::int32_t* length) override {
    auto* runs = static_cast<std::int64_t*>(runs_);
    std::size_t room = 0;
    check(cub::DeviceRunLengthEncode::Encode(nullptr, room, keys, different, length, runs, count),
          "finding blocks");
    grow(room_, room_bytes_, room);
    check(cub::DeviceRunLengthEncode::Encode(room_, room, keys, different, length, runs, count),
          "finding blocks");
    std::int64_t found = 0;
    download(&found, runs, sizeof found);
    return found;
  }

 private:
  void grow(void*& memory, std::size_t& bytes, std::size_t needed) {
    if (needed <= bytes) return;
    release(std::exchange(memory, nullptr));
    bytes = 0;
    memory = allocate(needed + needed / 8, "sorting particles");
    bytes = needed + needed / 8;
  }

  std::string name_;
  void* room_ = nullptr;
  void* spare_keys_ = nullptr;
  void* spare_values_ = nullptr;
  void* runs_ = nullptr;
  std::size_t room_bytes_ = 0;
  std::size_t spare_keys_bytes_ = 0;
  std::size_t spare_values_bytes_ = 0;
};

}  // namespace

std::unique_ptr<Device> open_device() {
  const GpuList found = find_gpus();
  if (found.gpus.empty()) throw UserError("no GPU: " + found.problem);
  check(cudaSetDevice(0), "opening the GPU");
  return std::make_unique<CudaDevice>(found.gpus[0].name);
}

}  // namespace cuda

namespace {

/// "CUDA 13.0".
std::string version_text() {
  return "CUDA " + std::to_string(CUDART_VERSION / 1000) + "." +
         std::to_string(CUDART_VERSION % 1000 / 10);
}

/// "CUDA 13.0 for 8.0, 9.0".
std::string build_text() {
  std::string text = version_text() + " for ";
  bool first = true;
  for (const int architecture : {__CUDA_ARCH_LIST__}) {
    if (!first) text += ", ";
    first = false;
    text += std::to_string(architecture / 100) + "." + std::to_string(architecture % 100 / 10);
  }
  return text;
}

std::string problem_text(cudaError_t error) {
  if (error == cudaErrorInsufficientDriver) {
    return "there is no NVIDIA driver, or it is older than " + version_text() + " needs";
  }
  if (error == cudaErrorNoDevice) return "the driver sees none";
  return cudaGetErrorString(error);
}

/// Whether the current GPU can load a kernel of this build.
bool runs_kernels() {
  cudaFuncAttributes attributes;
  const bool loads = cudaFuncGetAttributes(&attributes, probe) == cudaSuccess;
  (void)cudaGetLastError();
  return loads;
}

}  // namespace

GpuList find_gpus() {
  GpuList found;
  found.compiled = true;
  found.build = build_text();
  int count = 0;
  const cudaError_t error = cudaGetDeviceCount(&count);
  if (error != cudaSuccess) {
    (void)cudaGetLastError();
    found.problem = problem_text(error);
    return found;
  }
  for (int i = 0; i < count; ++i) {
    cudaDeviceProp properties;
    if (cudaGetDeviceProperties(&properties, i) != cudaSuccess) continue;
    found.gpus.push_back({properties.name, properties.major, properties.minor,
                          std::int64_t(properties.totalGlobalMem), properties.multiProcessorCount});
  }
  if (found.gpus.empty()) found.problem = "the driver reports none";
  if (!found.gpus.empty() && !runs_kernels()) {
    found.problem = found.gpus[0].name + " cannot run this build's kernels (" + found.build + ")";
    found.gpus.clear();
  }
  return found;
}

std::shared_ptr<const DeviceToolkit> gpu_toolkit(MemoryNeedReport on_need) {
  return cuda::make_toolkit(std::move(on_need));
}

}  // namespace scree
