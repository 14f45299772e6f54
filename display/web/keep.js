// Downloads and the clipboard.

export function save(name, parts, type) {
    const url = URL.createObjectURL(new Blob(parts, {type}));
    const link = document.createElement('a');
    link.href = url;
    link.download = name;
    link.click();
    // Once begun, the download has its own hold on the bytes.
    setTimeout(() => URL.revokeObjectURL(url), 10000);
}

// The clipboard exists in secure contexts only, and a page from another machine is none.
export async function copy(field) {
    try {
        await navigator.clipboard.writeText(field.value);
        return true;
    } catch {
        field.select();
        return document.execCommand('copy');
    }
}
