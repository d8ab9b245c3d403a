// SPDX-License-Identifier: Apache-2.0
// A function as an argument: who takes it is compiled once, not once for each function given to it.
//
// Promises: no allocation; it refers to the function, which must outlive it. A call is indirect, so
// a tick's loops take templates instead.
#pragma once

namespace stylet {

template <typename Signature>
class Function;

template <typename Result, typename... Arguments>
class Function<Result(Arguments...)> {
 public:
  template <typename Given>
  Function(const Given& given)  // NOLINT: a lambda is given as it is
      : given_(&given), call_([](const void* of, Arguments... arguments) -> Result {
          return (*static_cast<const Given*>(of))(arguments...);
        }) {}
  Result operator()(Arguments... arguments) const { return call_(given_, arguments...); }

 private:
  const void* given_;
  Result (*call_)(const void*, Arguments...);
};

}  // namespace stylet
