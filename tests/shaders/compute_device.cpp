#include "shaders/compute_device.h"

#ifdef HEIGHTLIGHT_VULKAN
#include <vulkan/vulkan.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace heightlight {
namespace {

constexpr std::uint32_t kGroupSize = 64;

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS)
    throw std::runtime_error(std::string(what) + ": VkResult " + std::to_string(result));
}

/// A handle that is destroyed with what it came from.
template <class Handle, class Parent>
class Owned {
 public:
  using Destroy = void (*)(Parent, Handle, const VkAllocationCallbacks*);
  Owned(Parent parent, Handle handle, Destroy destroy)
      : parent_(parent), handle_(handle), destroy_(destroy) {}
  ~Owned() { destroy_(parent_, handle_, nullptr); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  Handle get() const { return handle_; }

 private:
  Parent parent_;
  Handle handle_;
  Destroy destroy_;
};

template <class Handle>
using DeviceOwned = Owned<Handle, VkDevice>;

/// Creates what a device owns by one of Vulkan's vkCreate functions.
template <class Handle, class Info>
DeviceOwned<Handle> create(VkDevice device,
                           VkResult (*make)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*),
                           const Info& info, typename DeviceOwned<Handle>::Destroy destroy) {
  Handle handle = VK_NULL_HANDLE;
  check(make(device, &info, nullptr, &handle), "creating a Vulkan object");
  return {device, handle, destroy};
}

/// Memory that the processor and the device see, as a storage buffer.
class StorageBuffer {
 public:
  StorageBuffer(VkPhysicalDevice physical, VkDevice device, std::size_t floats)
      : device_(device),
        bytes_(floats * sizeof(float)),
        buffer_(make_buffer()),
        memory_(make_memory(physical)) {
    check(vkBindBufferMemory(device_, buffer_.get(), memory_.get(), 0), "binding memory");
    void* mapped = nullptr;
    check(vkMapMemory(device_, memory_.get(), 0, bytes_, 0, &mapped), "mapping memory");
    mapped_ = static_cast<float*>(mapped);
  }
  float* data() const { return mapped_; }
  VkDescriptorBufferInfo info() const { return {buffer_.get(), 0, bytes_}; }

 private:
  DeviceOwned<VkBuffer> make_buffer() const {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = bytes_;
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    return create(device_, vkCreateBuffer, info, vkDestroyBuffer);
  }
  DeviceOwned<VkDeviceMemory> make_memory(VkPhysicalDevice physical) const {
    constexpr VkMemoryPropertyFlags kWanted =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device_, buffer_.get(), &needs);
    VkPhysicalDeviceMemoryProperties has{};
    vkGetPhysicalDeviceMemoryProperties(physical, &has);
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = needs.size;
    while (info.memoryTypeIndex < has.memoryTypeCount &&
           ((needs.memoryTypeBits >> info.memoryTypeIndex & 1U) == 0 ||
            (has.memoryTypes[info.memoryTypeIndex].propertyFlags & kWanted) != kWanted))
      ++info.memoryTypeIndex;
    if (info.memoryTypeIndex == has.memoryTypeCount) throw std::runtime_error("no memory that both see");
    return create(device_, vkAllocateMemory, info, vkFreeMemory);
  }

  VkDevice device_;
  VkDeviceSize bytes_;
  DeviceOwned<VkBuffer> buffer_;
  DeviceOwned<VkDeviceMemory> memory_;
  float* mapped_ = nullptr;
};

DeviceOwned<VkDescriptorSetLayout> make_set_layout(VkDevice device) {
  std::array<VkDescriptorSetLayoutBinding, 2> bindings{};
  for (std::uint32_t i = 0; i < bindings.size(); ++i)
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = bindings.size();
  info.pBindings = bindings.data();
  return create(device, vkCreateDescriptorSetLayout, info, vkDestroyDescriptorSetLayout);
}

DeviceOwned<VkPipelineLayout> make_pipeline_layout(VkDevice device, VkDescriptorSetLayout set) {
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &set;
  return create(device, vkCreatePipelineLayout, info, vkDestroyPipelineLayout);
}

DeviceOwned<VkPipeline> make_pipeline(VkDevice device, VkPipelineLayout layout,
                                      std::span<const std::uint32_t> spirv) {
  VkShaderModuleCreateInfo module_info{};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module_info.codeSize = spirv.size_bytes();
  module_info.pCode = spirv.data();
  const auto module = create(device, vkCreateShaderModule, module_info, vkDestroyShaderModule);
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module.get();
  info.stage.pName = "main";
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline), "the pipeline");
  return {device, pipeline, vkDestroyPipeline};
}

DeviceOwned<VkDescriptorPool> make_descriptor_pool(VkDevice device) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = 1;
  info.poolSizeCount = 1;
  info.pPoolSizes = &size;
  return create(device, vkCreateDescriptorPool, info, vkDestroyDescriptorPool);
}

VkDescriptorSet bind_buffers(VkDevice device, VkDescriptorPool pool, VkDescriptorSetLayout layout,
                             const std::array<VkDescriptorBufferInfo, 2>& buffers) {
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = pool;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  check(vkAllocateDescriptorSets(device, &info, &set), "descriptors");
  VkWriteDescriptorSet write{};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set;
  write.descriptorCount = buffers.size();
  write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  write.pBufferInfo = buffers.data();
  vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
  return set;
}

/// Instance, device and queue of lavapipe.
class VulkanDevice final : public ComputeDevice {
 public:
  VulkanDevice(VkInstance instance, VkPhysicalDevice physical) : instance_(instance), physical_(physical) {
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueCount = 1;  // of family 0, the only one that lavapipe has
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    check(vkCreateDevice(physical_, &info, nullptr, &device_), "the device");
    vkGetDeviceQueue(device_, 0, 0, &queue_);
  }
  ~VulkanDevice() override {
    vkDestroyDevice(device_, nullptr);
    vkDestroyInstance(instance_, nullptr);
  }
  VulkanDevice(const VulkanDevice&) = delete;
  VulkanDevice& operator=(const VulkanDevice&) = delete;

  std::vector<float> run(std::span<const std::uint32_t> spirv, std::span<const float> inputs,
                         std::size_t samples, int floats_per_sample) override {
    const std::size_t results = samples * static_cast<std::size_t>(floats_per_sample);
    const StorageBuffer given(physical_, device_, inputs.size());
    const StorageBuffer found(physical_, device_, results);
    std::copy(inputs.begin(), inputs.end(), given.data());
    std::fill_n(found.data(), results, std::numeric_limits<float>::quiet_NaN());
    const auto set_layout = make_set_layout(device_);
    const auto layout = make_pipeline_layout(device_, set_layout.get());
    const auto pipeline = make_pipeline(device_, layout.get(), spirv);
    const auto pool = make_descriptor_pool(device_);
    const VkDescriptorSet set =
        bind_buffers(device_, pool.get(), set_layout.get(), {given.info(), found.info()});
    dispatch(pipeline.get(), layout.get(), set, static_cast<std::uint32_t>(samples) / kGroupSize);
    return {found.data(), found.data() + results};
  }

 private:
  void dispatch(VkPipeline pipeline, VkPipelineLayout layout, VkDescriptorSet set, std::uint32_t groups) {
    VkCommandPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    const auto pool = create(device_, vkCreateCommandPool, pool_info, vkDestroyCommandPool);
    VkCommandBufferAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = pool.get();
    info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(device_, &info, &commands), "commands");
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    check(vkBeginCommandBuffer(commands, &begin), "commands");
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    vkCmdDispatch(commands, groups, 1, 1);
    check(vkEndCommandBuffer(commands), "commands");
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    check(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "the work");
    check(vkQueueWaitIdle(queue_), "the work");
  }

  VkInstance instance_;
  VkPhysicalDevice physical_;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
};

}  // namespace

std::unique_ptr<ComputeDevice> open_compute_device(std::string& why_not) {
  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = VK_API_VERSION_1_0;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  VkInstance instance = VK_NULL_HANDLE;
  if (vkCreateInstance(&info, nullptr, &instance) != VK_SUCCESS) {
    why_not = "no Vulkan driver here (mesa-vulkan-drivers)";
    return nullptr;
  }
  std::uint32_t count = 0;
  vkEnumeratePhysicalDevices(instance, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  vkEnumeratePhysicalDevices(instance, &count, devices.data());
  for (const VkPhysicalDevice device : devices) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device, &properties);
    if (properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU)
      return std::make_unique<VulkanDevice>(instance, device);
  }
  vkDestroyInstance(instance, nullptr);
  why_not = "Vulkan has no device on the processor here (mesa-vulkan-drivers: lavapipe)";
  return nullptr;
}

}  // namespace heightlight

#else

namespace heightlight {

std::unique_ptr<ComputeDevice> open_compute_device(std::string& why_not) {
  why_not = "built without Vulkan (libvulkan-dev)";
  return nullptr;
}

}  // namespace heightlight

#endif
