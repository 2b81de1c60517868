// solver/base/registry.h
//
// A registry: a list of alternative methods for one task, each with a name. The command line, the help, the
// reports and the interactive window take the methods' names from the registry; no other code lists the names
// of the methods.

#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "solver/base/check.h"

namespace penumbra {

// A registry of methods, each of which makes a `Product` from `Options`. The source file of a method has a
// function that returns the method's description, a Method. The file that defines a registry lists the
// functions that return the descriptions of its methods. A program may add its own methods before it solves a
// scene.
template <class Product, class... Options>
class Registry {
 public:
  struct Method {
    std::string name;                     // the name of the method, as users write it on the command line
    std::string help;                     // one line of help about the method, without a full stop at the end
    std::vector<std::string> parameters;  // the names of the command-line options that only this method uses
    std::function<std::unique_ptr<Product>(const Options&...)> make;
  };

  // `kind` is the noun in messages such as "no KIND is called 'x'". The first method of a registry is the
  // default.
  Registry(std::string kind, std::vector<Method> methods) : kind_(std::move(kind)) {
    for (Method& method : methods) Add(std::move(method));
  }

  // Appends a method to the list. REQUIRES: no method of the registry has the name of the new method, and no
  // thread reads the registry.
  void Add(Method method) {
    for (const Method& other : methods_) PENUMBRA_CHECK(other.name != method.name);
    methods_.push_back(std::move(method));
  }

  const std::vector<Method>& methods() const { return methods_; }
  const std::string& kind() const { return kind_; }

  std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const Method& method : methods_) names.push_back(method.name);
    return names;
  }

  // Returns the method called `name`. Throws InputError, which lists all names, if no method has this name.
  const Method& Find(std::string_view name) const {
    std::string names;
    for (const Method& method : methods_) {
      if (method.name == name) return method;
      names += (names.empty() ? "" : ", ") + method.name;
    }
    throw InputError("no " + kind_ + " is called '" + std::string(name) + "'; give one of: " + names);
  }

  // Returns a new product made by the method called `name`. Throws InputError if no method has this name.
  std::unique_ptr<Product> Make(std::string_view name, const Options&... options) const {
    return Find(name).make(options...);
  }

 private:
  std::string kind_;
  std::vector<Method> methods_;
};

}  // namespace penumbra
