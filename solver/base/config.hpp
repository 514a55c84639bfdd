// SPDX-License-Identifier: Apache-2.0
/// \file
/// Compiler switches shared by all code that runs on CPU scalars, on SIMD lanes and in CUDA device
/// code.
#pragma once

// SCREE_FN marks a small function that is usable on host and device and is always inlined: point
// physics is a chain of such functions, and a call in the middle of it would spill all SIMD
// registers. SCREE_RARE marks one that is seldom called from there and must stay out of it.
#if defined(__CUDACC__)
#define SCREE_FN __host__ __device__ __forceinline__
#define SCREE_RARE __host__ __device__ __noinline__
#else
#define SCREE_FN __attribute__((always_inline)) inline
#define SCREE_RARE __attribute__((noinline, cold))
#endif

// SCREE_UNROLL before a loop with a small constant count: the loop vanishes, so its arrays live in
// registers.
#if defined(__CUDA_ARCH__)
#define SCREE_UNROLL _Pragma("unroll")
#elif defined(__CUDACC__)
#define SCREE_UNROLL
#else
#define SCREE_UNROLL _Pragma("GCC unroll 16")
#endif

// SCREE_UNROLL_ON_DEVICE: the same for GPUs only, where an array with a variable index falls out of
// the registers; on the CPU the rolled loop is the smaller and better one.
#if defined(__CUDA_ARCH__)
#define SCREE_UNROLL_ON_DEVICE _Pragma("unroll")
#else
#define SCREE_UNROLL_ON_DEVICE
#endif

// Passing 64-byte vectors by value has an ISA-dependent ABI. Every function that does so is always
// inlined, so no call ever crosses that ABI and the compiler's remark about it is noise.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif
