use super::*;

/// The sizes around those where another allocator or another page begins.
const SIZES: [usize; 8] = [
    1,
    PAGE,
    HUGE_PAGE - 1,
    HUGE_PAGE,
    HUGE_PAGE + 1,
    2 * HUGE_PAGE + PAGE,
    5 * HUGE_PAGE + 77,
    9 * HUGE_PAGE,
];

fn layout(size: usize, alignment: usize) -> Layout {
    Layout::from_size_align(size, alignment).unwrap()
}

/// Some places in `size` bytes, in every page.
fn places(size: usize) -> impl Iterator<Item = usize> {
    (0..size).step_by(1009)
}

/// A byte that tells places apart.
fn byte(place: usize) -> u8 {
    (place ^ place >> 8 ^ place >> 16) as u8
}

#[test]
fn memory_is_aligned_and_writable_and_zero_if_asked() {
    for size in SIZES {
        for alignment in [1, 64, ALIGNMENT, HUGE_PAGE] {
            let layout = layout(size, alignment);
            // SAFETY: the memory is as large as the layout, and freed with it.
            unsafe {
                let memory = HugePageAllocator.alloc_zeroed(layout);
                assert!(!memory.is_null() && memory.addr().is_multiple_of(alignment));
                let bytes = std::slice::from_raw_parts_mut(memory, size);
                assert!(bytes.iter().all(|byte| *byte == 0));
                bytes.fill(1);
                HugePageAllocator.dealloc(memory, layout);
                let memory = HugePageAllocator.alloc(layout);
                memory.write_bytes(2, size);
                HugePageAllocator.dealloc(memory, layout);
            }
        }
    }
}

#[test]
fn large_memory_begins_at_a_huge_page() {
    let layout = layout(3 * HUGE_PAGE, 4);
    // SAFETY: freed with the layout that it is allocated with.
    unsafe {
        let memory = HugePageAllocator.alloc(layout);
        assert!(memory.addr().is_multiple_of(HUGE_PAGE));
        HugePageAllocator.dealloc(memory, layout);
    }
}

#[test]
fn memory_keeps_its_content_from_any_size_to_any_other() {
    for from in SIZES {
        for to in SIZES {
            // SAFETY: only bytes below both sizes are read, and all memory is freed with the size
            // that it has.
            unsafe {
                let memory = HugePageAllocator.alloc(layout(from, 8));
                for place in places(from) {
                    memory.add(place).write(byte(place));
                }
                let memory = HugePageAllocator.realloc(memory, layout(from, 8), to);
                assert!(!memory.is_null(), "{from} to {to}");
                let kept =
                    places(from.min(to)).all(|place| memory.add(place).read() == byte(place));
                assert!(kept, "{from} to {to}");
                memory.write_bytes(3, to);
                HugePageAllocator.dealloc(memory, layout(to, 8));
            }
        }
    }
}

#[test]
fn memory_that_grows_into_its_neighbour_moves() {
    let size = 2 * HUGE_PAGE;
    // SAFETY: all memory is freed with the size that it has, and written within it.
    unsafe {
        let mut all = [1u8, 2, 3].map(|value| {
            let memory = HugePageAllocator.alloc(layout(size, 8));
            memory.write_bytes(value, size);
            memory
        });
        for memory in &mut all {
            *memory = HugePageAllocator.realloc(*memory, layout(size, 8), 2 * size);
        }
        for (memory, value) in all.into_iter().zip([1u8, 2, 3]) {
            let bytes = std::slice::from_raw_parts(memory, 2 * size);
            assert!(bytes[..size].iter().all(|byte| *byte == value));
            assert!(bytes[size..].iter().all(|byte| *byte == 0));
            HugePageAllocator.dealloc(memory, layout(2 * size, 8));
        }
    }
}

#[test]
fn more_than_there_is_is_refused_and_what_is_there_stays() {
    let most = layout(isize::MAX as usize - ALIGNMENT, 8);
    let small = layout(HUGE_PAGE, 8);
    // SAFETY: refused memory is not used, and the other is freed with its layout.
    unsafe {
        assert!(HugePageAllocator.alloc(most).is_null());
        assert!(HugePageAllocator.alloc_zeroed(most).is_null());
        let memory = HugePageAllocator.alloc(small);
        memory.write_bytes(7, HUGE_PAGE);
        assert!(
            HugePageAllocator
                .realloc(memory, small, most.size())
                .is_null()
        );
        assert_eq!(memory.add(HUGE_PAGE - 1).read(), 7);
        HugePageAllocator.dealloc(memory, small);
    }
}

#[test]
fn threads_allocate_at_once() {
    let work = |thread: usize| {
        for round in 0..20 {
            let size = HUGE_PAGE + (round + thread) * PAGE;
            // SAFETY: written within its size, and freed with the size that it has.
            unsafe {
                let memory = HugePageAllocator.alloc_zeroed(layout(size, 8));
                let bytes = std::slice::from_raw_parts_mut(memory, size);
                assert!(bytes.iter().step_by(ALIGNMENT).all(|byte| *byte == 0));
                bytes.fill(thread as u8);
                let memory = HugePageAllocator.realloc(memory, layout(size, 8), 2 * size);
                assert_eq!(memory.add(size - 1).read(), thread as u8);
                HugePageAllocator.dealloc(memory, layout(2 * size, 8));
            }
        }
    };
    std::thread::scope(|scope| {
        for thread in 1..5 {
            scope.spawn(move || work(thread));
        }
    });
}

#[test]
fn kept_memory_is_given_out_once() {
    let sizes = [2, 3, 5, 2, 9, 3, 4].map(|pages: usize| layout(pages * HUGE_PAGE, 8));
    let mut held: Vec<(*mut u8, Layout, u8)> = Vec::new();
    for round in 0..60u8 {
        let layout = sizes[usize::from(round) % sizes.len()];
        // SAFETY: the memory is as large as the layout, and freed with it.
        unsafe {
            let memory = HugePageAllocator.alloc(layout);
            memory.write_bytes(round, layout.size());
            held.push((memory, layout, round));
            if round % 3 != 0 {
                let place = usize::from(round) * 7 % held.len();
                let (memory, layout, written) = held.swap_remove(place);
                assert!(places(layout.size()).all(|place| *memory.add(place) == written));
                HugePageAllocator.dealloc(memory, layout);
            }
        }
    }
    for (memory, layout, written) in held {
        // SAFETY: as before.
        unsafe {
            assert!(places(layout.size()).all(|place| *memory.add(place) == written));
            HugePageAllocator.dealloc(memory, layout);
        }
    }
}
