//! The machine-dependent part of fault recovery: entering generated code, and leaving it from a signal handler.
//! For another machine this file, the check in `load` and the code generator's target need a twin; nothing else does.
#![allow(unsafe_code)] // Registers and the stack pointer.

use super::Activation;

#[cfg(not(target_os = "linux"))]
compile_error!("takt-runtime recovers from faults with Linux signals and thread timers");

#[cfg(target_arch = "x86_64")]
pub(super) use x86_64::{enter, leave, pc};

#[cfg(target_arch = "x86_64")]
mod x86_64 {
    use super::Activation;
    use libc::{REG_EFL, REG_RAX, REG_RIP, REG_RSP, ucontext_t};

    /// Calls `function(memory, frame, instance)`. Returns 0 at its normal end and 1 if [`leave`] ended it.
    #[unsafe(naked)]
    pub unsafe extern "sysv64" fn enter(
        function: *const u8,
        memory: *mut u8,
        frame: u32,
        instance: u32,
        activation: *mut Activation,
    ) -> u64 {
        // The pushes keep the registers that a function must preserve: faulting code does not restore them.
        std::arch::naked_asm!(
            "push rbp",
            "mov rbp, rsp",
            "push rbx",
            "push r12",
            "push r13",
            "push r14",
            "push r15",
            "sub rsp, 8",
            "mov [r8], rsp",
            "lea rax, [rip + 2f]",
            "mov [r8 + 8], rax",
            "mov rax, rdi",
            "mov rdi, rsi",
            "mov esi, edx",
            "mov edx, ecx",
            "call rax",
            "xor eax, eax",
            "2:",
            "add rsp, 8",
            "pop r15",
            "pop r14",
            "pop r13",
            "pop r12",
            "pop rbx",
            "pop rbp",
            "ret",
        )
    }

    /// Address of the interrupted instruction.
    ///
    /// # Safety
    /// `context` is what the kernel gave the handler.
    pub unsafe fn pc(context: *mut ucontext_t) -> u64 {
        // SAFETY: the caller's promise.
        unsafe { (*context).uc_mcontext.gregs[REG_RIP as usize] as u64 }
    }

    /// Makes the return from the signal handler a return from [`enter`] with 1.
    ///
    /// # Safety
    /// `context` is what the kernel gave the handler on the thread that is inside `activation`.
    pub unsafe fn leave(context: *mut ucontext_t, activation: &Activation) {
        const DIRECTION_FLAG: i64 = 0x400;
        // SAFETY: the caller's promise.
        let registers = unsafe { &mut (*context).uc_mcontext.gregs };
        registers[REG_RSP as usize] = activation.rsp as i64;
        registers[REG_RIP as usize] = activation.resume as i64;
        registers[REG_RAX as usize] = 1;
        registers[REG_EFL as usize] &= !DIRECTION_FLAG;
    }
}

#[cfg(not(target_arch = "x86_64"))]
pub(super) use elsewhere::{enter, leave, pc};

/// No code passes `load::check_target` on other machines, so that nothing here is reached.
#[cfg(not(target_arch = "x86_64"))]
mod elsewhere {
    use super::Activation;
    use libc::ucontext_t;

    pub unsafe fn enter(_: *const u8, _: *mut u8, _: u32, _: u32, _: *mut Activation) -> u64 {
        panic!("native code runs on x86-64 alone; the loader refuses it elsewhere")
    }
    pub unsafe fn pc(_: *mut ucontext_t) -> u64 {
        0
    }
    pub unsafe fn leave(_: *mut ucontext_t, _: &Activation) {}
}
